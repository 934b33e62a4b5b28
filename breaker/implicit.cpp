#include "breaker/implicit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/hydro/turning_body.hpp"

namespace crumble::breaker {

using Eigen::VectorXd;

namespace {

double farthest(const std::vector<Vector3>& x, const std::vector<Vector3>& from) {
  double largest = 0;
  for (std::size_t p = 0; p < x.size(); ++p) largest = std::max(largest, (x[p] - from[p]).squaredNorm());
  return std::sqrt(largest);
}

// By how much increments change the gap of an open pair that feels surface forces, at most, in the length over which
// these vary: gap and joining gap together.
double largest_approach(const Frame& frame, const VectorXd& q, const std::vector<double>& radius,
                        const SurfaceForceLaws& laws) {
  double largest = 0;
  const auto count = static_cast<std::int32_t>(radius.size());
  for (std::int32_t i = 0; i < count; ++i)
    for (std::int32_t j = i + 1; j < count; ++j) {
      const Vector3 D = frame.position[j] - frame.position[i];
      const double sum = radius[i] + radius[j], reach = sum + laws.range();
      if (D.squaredNorm() > reach * reach) continue;
      const double gap = D.norm() - sum, joined = laws(i, j).attraction.joined_gap();
      if (gap <= 0) continue;
      const double after = (D + q.segment<3>(6 * j) - q.segment<3>(6 * i)).norm() - sum;
      largest = std::max(largest, std::abs(after - gap) / (gap + joined));
    }
  return largest;
}

}  // namespace

Implicit::Implicit(const BreakupModel& model, const Protocol& protocol, const std::vector<double>& radius, Frame frame,
                   double tolerance)
    : Integrator(model, protocol, radius, std::move(frame)),
      tolerance_(tolerance),
      hydrodynamics_(radius, model.viscosity, model.hydro,
                     0.1 * tolerance > 10 * BodyHydrodynamics::single_error ? BodyHydrodynamics::Precision::float32
                                                                            : BodyHydrodynamics::Precision::float64),
      solver_(radius_, length_, network_.laws(), network_.surface_pairs()) {
  hydrodynamics_.renew_far_field(frame_.position);
  far_reference_ = near_reference_ = frame_.position;
  rate_.setZero(6 * static_cast<Eigen::Index>(radius.size()));
  last_rate_ = rate_;
  next_dt_ = event_step();
}

Frame Implicit::laboratory() const {
  Frame lab = frame_;
  for (auto& x : lab.position) x = rotation_ * x;
  for (auto& q : lab.orientation) q = (rotation_ * q).normalized();
  for (auto* field : {&lab.velocity, &lab.angular_velocity, &lab.force, &lab.torque})
    for (auto& v : *field) v = rotation_ * v;
  for (Contact& c : lab.contacts)
    for (Vector3* v : {&c.normal, &c.sliding, &c.rolling, &c.sliding_force, &c.rolling_torque}) *v = rotation_ * *v;
  return lab;
}

// The step within which events are located: a small strain, in weak flow that of its bound.
double Implicit::event_step() const {
  return 0.1 * tolerance_ * model_.viscosity / std::max(stress(frame_.time), model_.weak_stress);
}

// The matrices belong where the step is expected to end: second order like the formula itself.
void Implicit::renew_hydrodynamics() {
  std::vector<Vector3> expected = frame_.position;
  for (std::size_t p = 0; p < expected.size(); ++p)
    expected[p] += predicted_.segment<3>(6 * static_cast<Eigen::Index>(p));
  if (farthest(expected, far_reference_) > 0.1 * tolerance_ * length_) {
    hydrodynamics_.renew_far_field(expected);
    far_reference_ = near_reference_ = expected;
    deformed_ = true;
  } else if (farthest(expected, near_reference_) > 0.02 * tolerance_ * length_) {
    hydrodynamics_.renew_lubrication(expected);
    near_reference_ = expected;
  }
}

bool Implicit::step(double latest_time) {
  const double left = latest_time - frame_.time;
  double dt = next_dt_ < left ? next_dt_ : left;
  // Corners of a history are many: two equal steps to one, not a long and a short one from which to grow again.
  if (protocol_.has_history() && next_dt_ < left && left < 2 * next_dt_) dt = 0.5 * left;
  const double start = dt;
  for (int tries = 0; tries < 80; ++tries) {
    const Attempt result = attempt(dt, dt < left ? frame_.time + dt : latest_time);
    if (result.accepted) return result.changed;
    ++statistics_.rejected;
    dt = result.retry;
  }
  throw std::runtime_error(
      fmt::format("step {} at t = {:.6g} s ({:.4g} Pa): no step from {:.3g} s down to {:.3g} s "
                  "is accepted ({} contacts)",
                  frame_.step, frame_.time, stress(frame_.time), start, dt, frame_.contacts.size()));
}

double Implicit::largest_motion() const {
  double largest = 0;
  for (Eigen::Index i = 0; i < increment_.size(); i += 6)
    largest = std::max(largest, increment_.segment<3>(i).squaredNorm());
  return std::sqrt(largest);
}

// What the motion would be if it went on as before: the velocity constant after one step, linear after two.
void Implicit::predict(double dt) {
  predicted_.setZero(rate_.size());
  if (history_ >= 1) predicted_ = dt * rate_;
  if (history_ >= 2) predicted_ += dt * (dt + last_dt_) / (last_dt_ + second_last_dt_) * (rate_ - last_rate_);
}

// From the difference to the prediction, in units of what is allowed: 1/2 of it is the error of a first step, 2/11 that
// of the second-order formula at constant step.
double Implicit::local_error() const {
  if (history_ == 0) return 0;
  const VectorXd d = (history_ == 1 ? 0.5 : 0.2) * (increment_ - predicted_);
  double error = 0;
  for (Eigen::Index i = 0; i < d.size(); i += 3)
    error = std::max(error, d.segment<3>(i).norm() / (0.1 * tolerance_ * length_));
  for (const Contact& bond : frame_.contacts) {
    const Jkr& jkr = network_.laws()(bond.i, bond.j).jkr;
    const double gap = bond.normal.dot(d.segment<3>(6 * bond.j) - d.segment<3>(6 * bond.i));
    error = std::max(error, std::abs(gap) / (tolerance_ * (jkr.pull_off_gap - jkr.equilibrium_gap)));
  }
  return error;
}

Implicit::Attempt Implicit::attempt(double dt, double time) {
  predict(dt);
  renew_hydrodynamics();
  Quaternion rotation = rotation_;
  double turn_step = turn_step_ > 0 ? turn_step_ : dt;
  TurningBody(hydrodynamics_.turning(), 1e-9).advance(rotation, frame_.time, time, turn_step, [&](double t) {
    return gradient_at(t);
  });
  const Vector5 strain = TurningBody::strain_seen(rotation, gradient_at(time));

  // Velocities at the end by the backward difference formula of second order, which needs the step before:
  //   v = (1 + theta) q/dt - theta v_before,  theta = dt/(dt + dt_before)
  const double theta = history_ >= 1 ? dt / (dt + last_dt_) : 0;
  VectorXd load = hydrodynamics_.free_loads() * strain;
  if (theta > 0) load += theta * (hydrodynamics_.resistance() * rate_);
  increment_ = predicted_;
  const auto outcome = solver_.solve(frame_, {hydrodynamics_.resistance(), (1 + theta) / dt, load},
                                     1e-6 * tolerance_ * length_, increment_);
  statistics_.newton_iterations += outcome.iterations;
  statistics_.factorisations += outcome.factorisations;
  if (!outcome.converged) return {false, false, 0.25 * dt};

  const double smallest = event_step();
  const double moved = largest_motion() / (4 * tolerance_ * length_);
  if (moved > 1.2) return {false, false, std::max(0.1, 0.9 / moved) * dt};
  // Nothing else limits a step without a history, the first and those after a contact has come or gone.
  if (const SurfacePairs* near = network_.surface_pairs()) {
    const double approach = largest_approach(frame_, increment_, radius_, near->laws()) / (10 * tolerance_);
    if (approach > 1.2) return {false, false, std::max(0.1, 0.9 / approach) * dt};
  }
  if (dt > smallest) {
    const double fraction = network_.touch_fraction(increment_, 0.01 * tolerance_);
    if (fraction < 1) return {false, false, std::max(fraction * dt, 0.5 * smallest)};
    if (network_.ruptures(increment_)) return {false, false, std::max(0.3 * dt, smallest)};
  }
  const double error = local_error(), order = history_ >= 2 ? 3 : 2;
  if (error > 1 && dt > 0.1 * smallest)
    return {false, false, std::clamp(0.9 * std::pow(error, -1 / order), 0.1, 0.9) * dt};

  if (!deformed_) ++statistics_.rigid_steps;
  rotation_ = rotation;
  turn_step_ = turn_step;
  const bool changed = move(increment_, time);
  last_rate_ = rate_;
  second_last_dt_ = last_dt_;
  rate_ = increment_ / dt;
  last_dt_ = dt;
  history_ = changed ? 0 : std::min(history_ + 1, 2);
  const double growth = std::min(0.9 * std::pow(std::max(error, 1e-3), -1 / order), 0.9 / std::max(moved, 1e-2));
  next_dt_ = dt * std::clamp(growth, 0.3, 2.0);  // the formula is stable up to a ratio of 2.4
  if (changed) next_dt_ = std::min(next_dt_, event_step());
  for (const Contact& bond : frame_.contacts) deformed_ = deformed_ || bond.at_limit != 0;
  return {true, changed, 0};
}

void Implicit::fields(SavedFields& f) {
  Integrator::fields(f);
  f("next_step", next_dt_);
  f("turn_step", turn_step_);
  f("last_step", last_dt_);
  f("second_last_step", second_last_dt_);
  f("rotation", rotation_);
  f("rate", rate_);
  f("last_rate", last_rate_);
  f("far_field_at", far_reference_);
  f("lubrication_at", near_reference_);
  f("smooth_steps", history_);
  f("deformed", deformed_);
  if (!f.loading()) return;
  hydrodynamics_.renew_far_field(far_reference_);
  hydrodynamics_.renew_lubrication(near_reference_);
}

ExpectedSteps Implicit::expected_steps(double /*rigid_strength*/) const {
  const auto contacts = static_cast<double>(frame_.contacts.size());
  return {10 * contacts, 60 * contacts};
}

}  // namespace crumble::breaker
