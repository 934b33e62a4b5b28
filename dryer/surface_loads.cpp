#include "dryer/surface_loads.hpp"

#include <algorithm>
#include <cmath>

namespace crumble::dryer {

double stiff_gap(const DryingModel& model, double a, double soft, double solids, double R) {
  if (!model.surface_forces) return 0;
  const SurfaceForces& forces = *model.surface_forces;
  const std::vector<double> radius{a, a};
  const BondLaws bonds(model.contact, model.material, radius);
  SurfaceForceLaws laws(forces, bonds, radius);
  const double before = std::pow(model.droplet.initial_radius, 3) - solids;
  laws.set_ionic_strength(concentrated(forces.electrolyte.ionic_strength, before,
                                       std::max(R * R * R - solids, 1e-9 * before), forces.solubility));
  return laws.gap_of_stiffness(soft);
}

SurfaceLoads::SurfaceLoads(const DryingModel& model, const BondLaws& contacts, const Particles& particles, double soft,
                           double margin)
    : particles_(particles),
      pairs_(*model.surface_forces, model.droplet, contacts, particles, margin),
      soft_(soft),
      margin_(margin) {}

void SurfaceLoads::begin(const Frame& frame, double R) {
  pairs_.update(frame, R);
  const SurfaceForceLaws& laws = pairs_.laws();
  if (ionic_strength() != stiff_gap_at_) {
    stiff_gap_ = laws.gap_of_stiffness(soft_);
    stiff_gap_at_ = ionic_strength();
  }
  stiff_.clear();
  soft_block_.begin(laws);
  const auto& radius = particles_.radius;
  for (const Pair& pair : pairs_.pairs()) {
    const double reach = radius[pair.i] + radius[pair.j] + stiff_gap_ + margin_;
    if ((frame.position[pair.j] - frame.position[pair.i]).squaredNorm() < reach * reach)
      stiff_.push_back(pair);
    else
      soft_block_.add(pair.i, pair.j, laws(pair.i, pair.j), radius[pair.i], radius[pair.j], false);
  }
  soft_force_.assign(radius.size(), Quad(0.0f));
  if (soft_block_.size() == 0) return;
  position_.resize(radius.size());
  for (std::size_t p = 0; p < radius.size(); ++p) position_[p] = position(frame.position[p]);
  soft_block_.add_forces(position_.data(), soft_force_.data());
}

double SurfaceLoads::stiffness_of_repulsion(const Frame& frame) const {
  std::vector<double> sum(particles_.radius.size(), 0);
  double most = 0;
  for (const Pair& pair : stiff_) {
    const double gap = (frame.position[pair.j] - frame.position[pair.i]).norm() - particles_.radius[pair.i] -
                       particles_.radius[pair.j];
    const double k = pairs_.laws()(pair.i, pair.j).repulsion.stiffness(std::max(gap - margin_, 0.0));
    for (const std::int32_t p : {pair.i, pair.j}) most = std::max(most, sum[p] += k);
  }
  return most;
}

void SurfaceLoads::gather(const std::vector<std::int32_t>& place, std::size_t places,
                          const std::vector<Contact>& contacts) {
  const SurfaceForceLaws& laws = pairs_.laws();
  stiff_block_.begin(laws);
  force_.assign(places, Quad(0.0f));
  auto bond = contacts.begin();
  for (const Pair& pair : stiff_) {
    while (bond != contacts.end() && Pair{bond->i, bond->j} < pair) ++bond;
    stiff_block_.add(place[pair.i], place[pair.j], laws(pair.i, pair.j), particles_.radius[pair.i],
                     particles_.radius[pair.j], bond != contacts.end() && Pair{bond->i, bond->j} == pair);
  }
}

void SurfaceLoads::set_bonded(const Pair& pair, bool bonded) {
  const auto found = std::lower_bound(stiff_.begin(), stiff_.end(), pair);
  if (found != stiff_.end() && *found == pair)
    stiff_block_.set_bonded(static_cast<std::size_t>(found - stiff_.begin()), bonded);
}

void SurfaceLoads::evaluate(const std::vector<Position>& position) {
  std::fill(force_.begin(), force_.end(), Quad(0.0f));
  stiff_block_.add_forces(position.data(), force_.data());
}

}  // namespace crumble::dryer
