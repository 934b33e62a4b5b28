#include "dryer/implicit.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/contact/kinematics.hpp"
#include "dryer/displacement.hpp"

namespace crumble::dryer {

namespace {

// In units of the largest displacement: what a step is refused for.
constexpr double too_far = 1.5;

// How much nearer a pair may come in one step, in the smallest radius. Pairs within it are always listed, so that what
// a step finds does not depend on when the list was made, and so not on a restart.
double approach(const ImplicitControl& control) { return 2 * too_far * snap * control.largest_displacement; }

}  // namespace

Implicit::Implicit(const DryingModel& model, Agglomerate& state, const ImplicitControl& control)
    : Integrator(model, state, 0.2 + approach(control), approach(control)),
      control_(control),
      implicit_(model, state, laws_),
      rate_(state.particles.size(), Vector6::Zero()) {
  for (auto* field : {&state.state.velocity, &state.state.angular_velocity})
    if (field->size() != state.particles.size()) field->assign(state.particles.size(), Vector3::Zero());
}

void Implicit::fields(SavedFields& f) {
  Integrator::fields(f);
  f("next_step", next_dt_);
  f("rate", rate_);
}

// The step that moves the front by the largest displacement allowed, or up to the next particle if nothing moves.
double Implicit::proposal(double latest_time) const {
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

void Implicit::step(double latest_time) {
  double dt = proposal(latest_time);
  const double start = dt;
  for (int tries = 0; tries < 60; ++tries) {
    const double before = state_.state.time;
    const Attempt result = attempt(dt);
    if (result.accepted) return require_advance(dt, latest_time - before);
    ++statistics_.rejected;
    take_back_bonds();
    dt = result.retry;
  }
  throw std::runtime_error(fmt::format(
      "step {} at t = {:.6g} s: no step length from {:.3g} s down to {:.3g} s converges (particles {}, bonds {})",
      state_.state.step, state_.state.time, start, dt, state_.particles.size(), state_.state.contacts.size()));
}

// A run takes some steps while the front goes on by the largest displacement, or a few hundred where much falls into
// place at once. Where contacts open again in the step after the one that made them, the steps never grow.
void Implicit::require_advance(double dt, double left) {
  const double travel = control_.largest_displacement * smallest_radius(), R = front_.radius(state_.state.time);
  if (R < mark_ - travel || mark_ == std::numeric_limits<double>::infinity()) {
    mark_ = R;
    short_steps_ = 0;
  }
  const double front = front_.time_at(std::max(R - travel, 0.0)) - state_.state.time;
  if (dt < 0.1 * std::min(left, front)) ++short_steps_;
  const double most = 500 + 5.5 * std::pow(static_cast<double>(state_.particles.size()), 0.75);
  if (static_cast<double>(short_steps_) < most) return;
  throw std::runtime_error(fmt::format(
      "step {} at t = {:.6g} s: {} steps have moved the surface by less than {:.3g} nm, from R = {:.4g} nm, and do not "
      "grow longer ({} contacts, which may open as soon as they are made): the implicit integrator does not bring this "
      "scene to an end. Try another integrator.method or, with contact.law = \"cundall-strack\", another poisson_ratio",
      state_.state.step, state_.state.time, short_steps_, 1e9 * travel, 1e9 * mark_, state_.state.contacts.size()));
}

void Implicit::refresh() {
  if (!network_changed_) return;
  implicit_.set_network(activity_.active());
  network_changed_ = false;
}

void Implicit::predict(double dt) {
  const auto& active = activity_.active();
  for (std::size_t k = 0; k < active.size(); ++k) implicit_.increments()[k] = dt * rate_[active[k]];
}

// In the radius.
double Implicit::displacement() {
  moves_.clear();
  const auto& active = activity_.active();
  for (std::size_t k = 0; k < active.size(); ++k)
    moves_.push_back(implicit_.increments()[k].head<3>().norm() / state_.particles.radius[active[k]]);
  return largest_but_snaps(moves_);
}

Vector3 Implicit::moved(std::int32_t p) const { return state_.state.position[p] + implicit_.translation(p); }

// Open pairs that overlap by more than the precision at the end of the step, each with the fraction of the step at
// which it touches, by the secant.
void Implicit::find_touches() {
  const Frame& f = state_.state;
  touches_.clear();
  for (const Pair& pair : open_.pairs()) {
    if (!activity_.is_active(pair.i) && !activity_.is_active(pair.j)) continue;
    const double a_i = state_.particles.radius[pair.i], a_j = state_.particles.radius[pair.j];
    const double precision = control_.contact_precision * pair_radius(a_i, a_j);
    const double reach = a_i + a_j - precision;
    const double squared = (moved(pair.j) - moved(pair.i)).squaredNorm();
    if (squared > reach * reach) continue;
    const double after = std::sqrt(squared) - a_i - a_j;
    const double before = (f.position[pair.j] - f.position[pair.i]).norm() - a_i - a_j;
    touches_.push_back({pair, std::clamp(before / (before - after), 0.0, 1.0)});
  }
}

// Bonds them for what is left of the step after their touch: their springs start with what they must not remember.
void Implicit::bond_touches() {
  for (const auto& [pair, fraction] : touches_) {
    const Motion i = motion_of(pair.i), j = motion_of(pair.j);
    Contact& made = bond(pair);
    const double l_i = lever_arm(made, state_.particles.radius[pair.i], state_.particles.radius[pair.j]);
    const double l_j = lever_arm(made, state_.particles.radius[pair.j], state_.particles.radius[pair.i]);
    const RelativeMotion before_touch =
        relative_motion(made.normal, j.displacement - i.displacement, i.rotation, j.rotation, l_i, l_j);
    made.sliding = -fraction * before_touch.sliding;
    made.rolling = -fraction * before_touch.rolling;
    made.twisting = -fraction * before_touch.twisting;
    provisional_.push_back(pair);
  }
  network_changed_ = true;
}

void Implicit::take_back_bonds() {
  if (provisional_.empty()) return;
  std::sort(provisional_.begin(), provisional_.end());
  std::erase_if(state_.state.contacts, [&](const Contact& c) {
    return std::binary_search(provisional_.begin(), provisional_.end(), Pair{c.i, c.j});
  });
  for (const Pair& pair : provisional_) open_.open(pair);
  provisional_.clear();
  network_changed_ = true;
}

Implicit::Attempt Implicit::attempt(double dt) {
  const double R = front_.radius(state_.state.time + dt);
  if (activity_.front_at(R)) network_changed_ = true;
  refresh();
  predict(dt);
  for (int round = 0;; ++round) {
    const auto outcome = implicit_.solve(dt, R, 1e-6 * smallest_radius());
    statistics_.newton_iterations += outcome.iterations;
    if (!outcome.converged) return {false, 0.3 * dt};
    const double moved = displacement() / control_.largest_displacement;
    if (moved > too_far) return {false, std::max(0.2, 0.9 / moved) * dt};
    find_touches();
    // What still touches after ten rounds is bonded at the end of the step, overlap and all.
    if (touches_.empty() || round == 10) {
      next_dt_ = dt * std::clamp(0.9 / std::max(moved, 1e-3), 0.5, 2.0);
      break;
    }
    bond_touches();
    refresh();
  }
  accept(dt);
  return {true, 0};
}

void Implicit::accept(double dt) {
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
  statistics_.contacts_made += static_cast<std::int64_t>(provisional_.size());
  provisional_.clear();
  ++statistics_.steps;
  statistics_.particle_steps += static_cast<std::int64_t>(active.size());
  if (advance_bonds([&](std::int32_t p) { return motion_of(p); })) network_changed_ = true;
  front_.follow(state_);
}

Work Implicit::expected_work(const DryingModel& model, const std::vector<double>& radius,
                             const ImplicitControl& control, const StepTimes& times) {
  const double N = static_cast<double>(radius.size());
  const double advance = model.droplet.initial_radius / radius.back() / control.largest_displacement;
  Work work;
  work.steps = advance / 0.8 + 5.5 * std::pow(N, 0.75);
  work.add_up([](double fraction) { return 1 - std::pow(1 - fraction, 3); });
  work.seconds = std::pow(N / times.particles, 0.23) * N * work.steps * times.packed;
  return work;
}

}  // namespace crumble::dryer
