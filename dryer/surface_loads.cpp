#include "dryer/surface_loads.hpp"

#include <algorithm>

namespace crumble::dryer {

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
