#include "dryer/surface_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "dryer/liquid_volume.hpp"

namespace crumble::dryer {

namespace {
// The list is wider than what is asked of it by this share of the range, so that it need not be made anew so often.
constexpr double skin = 0.2;
}  // namespace

double stepped_ionic_strength(const SurfaceForces& forces, double volume_before, double volume) {
  constexpr double step = 0.002;
  const double before = forces.electrolyte.ionic_strength;
  const double now = concentrated(before, volume_before, volume, forces.solubility);
  return now >= forces.solubility ? forces.solubility
                                  : before * std::exp(step * std::round(std::log(now / before) / step));
}

SurfacePairs::SurfacePairs(const SurfaceForces& forces, const Droplet& droplet, const BondLaws& contacts,
                           const Particles& particles, double margin)
    : particles_(particles),
      laws_(forces, contacts, particles.radius),
      volume_at_start_(liquid_volume(particles, droplet.initial_radius)),
      margin_(margin),
      list_((1 + skin) * laws_.range() + margin, laws_.range() + margin) {}

void SurfacePairs::update(const Frame& frame, double R) {
  const double now = stepped_ionic_strength(laws_.forces(), volume_at_start_, liquid_volume(particles_, frame, R));
  if (now != laws_.electrolyte().ionic_strength) laws_.set_ionic_strength(now);
  list_.update(frame.position, particles_.radius, {});
  pairs_.clear();
  const double range = laws_.range() + margin_;
  const auto wet = [&](std::int32_t p) { return frame.position[p].squaredNorm() < R * R; };
  for (const Pair& pair : list_.pairs()) {
    const double reach = particles_.radius[pair.i] + particles_.radius[pair.j] + range;
    if ((frame.position[pair.j] - frame.position[pair.i]).squaredNorm() < reach * reach && wet(pair.i) && wet(pair.j))
      pairs_.push_back(pair);
  }
}

void SurfacePairs::add_forces(const Frame& frame, std::vector<Vector3>& force) const {
  auto bond = frame.contacts.begin();
  for (const Pair& pair : pairs_) {
    while (bond != frame.contacts.end() && Pair{bond->i, bond->j} < pair) ++bond;
    const bool bonded = bond != frame.contacts.end() && Pair{bond->i, bond->j} == pair;
    const Vector3 apart = frame.position[pair.j] - frame.position[pair.i];
    const double r = apart.norm(), gap = r - particles_.radius[pair.i] - particles_.radius[pair.j];
    const PairForces forces = laws_(pair.i, pair.j);
    const Vector3 pull = (bonded ? forces.bonded_tension(gap) : forces.open_tension(gap)) / r * apart;
    force[pair.i] += pull;
    force[pair.j] -= pull;
  }
}

}  // namespace crumble::dryer
