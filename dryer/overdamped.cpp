#include "dryer/overdamped.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/agglomerate/bond.hpp"

namespace crumble {

namespace {
constexpr double skin_over_a = 0.2;
}

Overdamped::Overdamped(const DryingModel& model, Agglomerate& state, const OverdampedControl& control)
    : model_(model),
      state_(state),
      control_(control),
      laws_(model.contact, model.material, state.particles.radius),
      open_(skin_over_a * *std::min_element(state.particles.radius.begin(), state.particles.radius.end())),
      activity_(state.particles, state.state),
      implicit_(model, state, laws_),
      rate_(state.particles.size(), Vector6::Zero()) {
  open_.update(state_.state.position, state_.particles.radius, state_.state.contacts);
  activity_.front_at(model_.droplet.radius(state_.state.time));
}

// The step that moves the front by the largest displacement allowed, or up to the next particle if nothing moves.
double Overdamped::proposal(double latest_time) const {
  const Frame& f = state_.state;
  const double R = model_.droplet.radius(f.time);
  const double a = *std::min_element(state_.particles.radius.begin(), state_.particles.radius.end());
  bool at_front = false;
  for (const std::int32_t p : activity_.active())
    at_front = at_front || std::abs(f.position[p].norm() - R) < state_.particles.radius[p];
  const double travel = control_.largest_displacement * a;
  double R_next = R - travel;
  if (!at_front) {
    // Nothing is at the surface: run to the next particle that it will reach, active or not.
    R_next = 0;
    for (std::size_t p = 0; p < f.position.size(); ++p) {
      const double reach = f.position[p].norm() + state_.particles.radius[p];
      if (reach <= R) R_next = std::max(R_next, reach - travel);
    }
  }
  double dt = model_.droplet.time_at(std::max(R_next, 0.0)) - f.time;
  if (next_dt_ > 0) dt = std::min(dt, next_dt_);
  return std::min(dt, latest_time - f.time);
}

void Overdamped::step(double latest_time) {
  double dt = proposal(latest_time);
  const double start = dt;
  for (int tries = 0; tries < 60; ++tries) {
    const Attempt result = attempt(dt);
    if (result.accepted) return;
    ++statistics_.rejected;
    dt = result.retry;
  }
  throw std::runtime_error(fmt::format(
      "step {} at t = {:.6g} s: no step length from {:.3g} s down to {:.3g} s converges (particles {}, bonds {})",
      state_.state.step, state_.state.time, start, dt, state_.particles.size(), state_.state.contacts.size()));
}

void Overdamped::refresh() {
  if (!network_changed_) return;
  implicit_.set_network(activity_.active());
  network_changed_ = false;
}

void Overdamped::predict(double dt) {
  const auto& active = activity_.active();
  for (std::size_t k = 0; k < active.size(); ++k) implicit_.increments()[k] = dt * rate_[active[k]];
}

double Overdamped::largest_displacement() const {
  double largest = 0;
  const auto& active = activity_.active();
  for (std::size_t k = 0; k < active.size(); ++k)
    largest = std::max(largest, implicit_.increments()[k].head<3>().norm() / state_.particles.radius[active[k]]);
  return largest;
}

// The fraction of the step at which the first open pair touches, 1 if none overlaps by more than the precision.
double Overdamped::touch_fraction() const {
  const Frame& f = state_.state;
  double first = 1;
  const auto moved = [&](std::int32_t p) -> Vector3 {
    return activity_.is_active(p) ? Vector3(f.position[p] + implicit_.translation(p)) : f.position[p];
  };
  for (const Pair& pair : open_.pairs()) {
    if (!activity_.is_active(pair.i) && !activity_.is_active(pair.j)) continue;
    const double a_i = state_.particles.radius[pair.i], a_j = state_.particles.radius[pair.j];
    const double precision = control_.contact_precision * pair_radius(a_i, a_j);
    const double after = (moved(pair.j) - moved(pair.i)).norm() - a_i - a_j;
    if (after > -precision) continue;
    const double before = (f.position[pair.j] - f.position[pair.i]).norm() - a_i - a_j;
    // Aim at half the precision, so that the secant lands within it.
    first = std::min(first, std::clamp((before + 0.5 * precision) / (before - after), 0.0, 0.9));
  }
  return first;
}

Overdamped::Attempt Overdamped::attempt(double dt) {
  if (activity_.front_at(model_.droplet.radius(state_.state.time + dt))) network_changed_ = true;
  refresh();
  predict(dt);
  const double a = *std::min_element(state_.particles.radius.begin(), state_.particles.radius.end());
  ++statistics_.solves;
  const auto outcome = implicit_.solve(dt, model_.droplet.radius(state_.state.time + dt), 1e-6 * a);
  statistics_.newton_iterations += outcome.iterations;
  if (!outcome.converged) return {false, 0.3 * dt};
  const double moved = largest_displacement() / control_.largest_displacement;
  if (moved > 1.5) return {false, std::max(0.2, 0.9 / moved) * dt};
  // A touch within a picometre-scale time step cannot be resolved further: then the overlap stands as it is.
  const double fraction = touch_fraction();
  if (fraction < 1 && fraction > 1e-3) return {false, fraction * dt};
  accept(dt);
  next_dt_ = dt * std::clamp(0.9 / std::max(moved, 1e-3), 0.5, fraction < 1 ? 1.0 : 2.0);
  return {true, 0};
}

void Overdamped::accept(double dt) {
  Frame& f = state_.state;
  const auto& active = activity_.active();
  for (std::size_t k = 0; k < active.size(); ++k) {
    f.position[active[k]] += implicit_.increments()[k].head<3>();
    rate_[active[k]] = implicit_.increments()[k] / dt;
  }
  f.time += dt;
  ++f.step;
  ++statistics_.steps;

  bool lost = false;
  for (Contact& bond : f.contacts) {
    const BondLaw& law = laws_(bond.i, bond.j);
    const double a_i = state_.particles.radius[bond.i], a_j = state_.particles.radius[bond.j];
    advance(bond, law,
            {f.position[bond.j] - f.position[bond.i], implicit_.translation(bond.j) - implicit_.translation(bond.i),
             implicit_.rotation(bond.i), implicit_.rotation(bond.j), a_i, a_j});
    statistics_.largest_overlap = std::max(statistics_.largest_overlap, -bond.gap / pair_radius(a_i, a_j));
    if (bond.gap > law.lost_gap()) {
      bond.born = -1;
      lost = true;
      open_.open({bond.i, bond.j});
      ++statistics_.contacts_lost;
    }
  }
  if (lost) {
    std::erase_if(f.contacts, [](const Contact& bond) { return bond.born < 0; });
    network_changed_ = true;
  }
  open_.update(f.position, state_.particles.radius, f.contacts);
  make_contacts();
}

void Overdamped::make_contacts() {
  Frame& f = state_.state;
  std::vector<Pair> made;
  for (const Pair& pair : open_.pairs()) {
    const double reach = state_.particles.radius[pair.i] + state_.particles.radius[pair.j];
    if ((f.position[pair.j] - f.position[pair.i]).squaredNorm() <= reach * reach &&
        (activity_.is_active(pair.i) || activity_.is_active(pair.j)))
      made.push_back(pair);
  }
  for (const Pair& pair : made) {
    open_.close(pair);
    activity_.wake(pair.i);
    activity_.wake(pair.j);
    const Contact bond = make_bond(laws_(pair.i, pair.j), pair.i, pair.j, f.position[pair.j] - f.position[pair.i],
                                   state_.particles.radius[pair.i], state_.particles.radius[pair.j], f.step);
    const auto place =
        std::lower_bound(f.contacts.begin(), f.contacts.end(), pair, [](const Contact& c, const Pair& q) {
          return Pair{c.i, c.j} < q;
        });
    f.contacts.insert(place, bond);
    ++statistics_.contacts_made;
  }
  network_changed_ = network_changed_ || !made.empty();
}

}  // namespace crumble
