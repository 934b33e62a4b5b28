#include "dryer/integrator.hpp"

#include <algorithm>

#include "common/agglomerate/network.hpp"

namespace crumble::dryer {

namespace {
double smallest(const std::vector<double>& radius) { return *std::min_element(radius.begin(), radius.end()); }
}  // namespace

Integrator::Integrator(const DryingModel& model, Agglomerate& state, double skin, double complete)
    : model_(model),
      state_(state),
      laws_(model.contact, model.material, state.particles.radius),
      front_(model.droplet, model.crust_diffusivity),
      open_(skin * smallest(state.particles.radius), complete * smallest(state.particles.radius)),
      activity_(state.particles, state.state),
      smallest_radius_(smallest(state.particles.radius)) {
  const Frame& f = state.state;
  if (skin > 0) open_.update(f.position, state.particles.radius, f.contacts);
  if (f.time == 0) activity_.front_at(front_.radius(0));  // later the front may be slower than it looks: fields()
  if (model.thermal_energy > 0 || model.surface_forces)
    for (std::size_t p = 0; p < state.particles.size(); ++p) activity_.wake(static_cast<std::int32_t>(p));
}

void Integrator::advance_bond(Contact& bond, const Motion& i, const Motion& j, bool& lost) {
  const Frame& f = state_.state;
  const double a_i = state_.particles.radius[bond.i], a_j = state_.particles.radius[bond.j];
  const BondMotion motion{
      f.position[bond.j] - f.position[bond.i], j.displacement - i.displacement, i.rotation, j.rotation, a_i, a_j};
  const bool loses = advance_or_lose(bond, laws_(bond.i, bond.j), motion, open_);
  statistics_.largest_overlap = std::max(statistics_.largest_overlap, -bond.gap / pair_radius(a_i, a_j));
  statistics_.contacts_lost += loses;
  lost = lost || loses;
}

bool Integrator::update_network(bool lost) {
  Frame& f = state_.state;
  const auto& radius = state_.particles.radius;
  if (lost) drop_lost(f.contacts);
  open_.update(f.position, radius, f.contacts);
  bool made = false;
  for (const Pair& pair : touching(open_, f.position, radius)) {
    if (!activity_.is_active(pair.i) && !activity_.is_active(pair.j)) continue;
    bond(pair);
    ++statistics_.contacts_made;
    made = true;
  }
  return lost || made;
}

Contact& Integrator::bond(const Pair& pair) {
  activity_.wake(pair.i);
  activity_.wake(pair.j);
  return make_bond(pair, laws_, state_.particles.radius, state_.state, open_);
}

void Integrator::fields(SavedFields& f) {
  f("steps", statistics_.steps);
  f("rejected", statistics_.rejected);
  f("newton_iterations", statistics_.newton_iterations);
  f("particle_steps", statistics_.particle_steps);
  f("contacts_made", statistics_.contacts_made);
  f("contacts_lost", statistics_.contacts_lost);
  f("largest_overlap", statistics_.largest_overlap);
  front_.fields(f);
  activity_.fields(f);
}

}  // namespace crumble::dryer
