#include "dryer/overdamped.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace crumble {

Overdamped::Overdamped(const DryingModel& model, Agglomerate& state, const OverdampedControl& control)
    : Integrator(model, state, 0.2),
      control_(control),
      implicit_(model, state, laws_),
      rate_(state.particles.size(), Vector6::Zero()) {
  for (auto* field : {&state.state.velocity, &state.state.angular_velocity})
    if (field->size() != state.particles.size()) field->assign(state.particles.size(), Vector3::Zero());
}

Integrator::Memory Overdamped::memory() const {
  Memory memory = Integrator::memory();
  memory.numbers.push_back(next_dt_);
  for (const Vector6& rate : rate_) memory.numbers.insert(memory.numbers.end(), rate.begin(), rate.end());
  return memory;
}

void Overdamped::recall(const Memory& memory) {
  Integrator::recall(memory);
  next_dt_ = memory.numbers.at(1);
  for (std::size_t p = 0; p < rate_.size(); ++p)
    for (int k = 0; k < 6; ++k) rate_[p][k] = memory.numbers.at(2 + 6 * p + k);
}

// The step that moves the front by the largest displacement allowed, or up to the next particle if nothing moves.
double Overdamped::proposal(double latest_time) const {
  const Frame& f = state_.state;
  const double R = front_.radius(f.time);
  // Behind a crust the front has to be followed even where it touches nobody.
  bool at_front = front_.may_slow_down();
  for (const std::int32_t p : activity_.active())
    at_front = at_front || std::abs(f.position[p].norm() - R) < state_.particles.radius[p];
  const double travel = control_.largest_displacement * smallest_radius();
  double R_next = R - travel;
  if (!at_front) {
    // Nothing is at the surface: run to the next particle that it will reach, active or not.
    R_next = 0;
    for (std::size_t p = 0; p < f.position.size(); ++p) {
      const double reach = f.position[p].norm() + state_.particles.radius[p];
      if (reach <= R) R_next = std::max(R_next, reach - travel);
    }
  }
  double dt = front_.time_at(std::max(R_next, 0.0)) - f.time;
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
  if (activity_.front_at(front_.radius(state_.state.time + dt))) network_changed_ = true;
  refresh();
  predict(dt);
  const auto outcome = implicit_.solve(dt, front_.radius(state_.state.time + dt), 1e-6 * smallest_radius());
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
    const std::int32_t p = active[k];
    f.position[p] += implicit_.increments()[k].head<3>();
    rate_[p] = implicit_.increments()[k] / dt;
    f.velocity[p] = rate_[p].head<3>();
    f.angular_velocity[p] = rate_[p].tail<3>() / state_.particles.radius[p];
  }
  f.time += dt;
  ++f.step;
  ++statistics_.steps;
  statistics_.particle_steps += static_cast<std::int64_t>(active.size());
  const auto motion_of = [&](std::int32_t p) { return Motion{implicit_.translation(p), implicit_.rotation(p)}; };
  if (advance_bonds(motion_of)) network_changed_ = true;
  front_.follow(state_);
}

}  // namespace crumble
