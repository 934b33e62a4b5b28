#include "breaker/explicit_euler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "common/agglomerate/bond_increment.hpp"

namespace crumble::breaker {

using Eigen::VectorXd;

ExplicitEuler::ExplicitEuler(const BreakupModel& model, const Protocol& protocol, const std::vector<double>& radius,
                             Frame frame, double step, bool allow_unstable, double coarsening)
    : Integrator(model, protocol, radius, std::move(frame)) {
  renew(frame_.position);
  limit_ = measured_limit();
  // Without contacts, half of what a free sphere on one of them, or on the stiffest gap of surface forces, would be
  // allowed.
  double stiffest = Jkr(model.material, length_).tangent_stiffness();
  if (const SurfacePairs* near = network_.surface_pairs())
    stiffest = std::max(stiffest, near->laws().largest_stiffness());
  const double loose = 6 * std::numbers::pi * model.viscosity * length_ / stiffest;
  dt_ = coarsening * (step > 0 ? step : 0.5 * std::min(limit_, loose));
  if (dt_ > 0.95 * limit_ && !allow_unstable)
    throw std::invalid_argument(fmt::format(
        "a step of {:.3g} s is beyond the stability limit of the explicit integrator, 2/lambda_max = {:.3g} s", dt_,
        limit_));
}

void ExplicitEuler::renew(const std::vector<Vector3>& position) {
  hydrodynamics_ = std::make_unique<LaggedHydrodynamics>(Spheres{position, radius_}, model_.viscosity, model_.hydro);
}

double ExplicitEuler::measured_limit() {
  const Eigen::Index n = 6 * static_cast<Eigen::Index>(radius_.size());
  if (frame_.contacts.empty()) return std::numeric_limits<double>::infinity();
  VectorXd x(n);
  for (Eigen::Index k = 0; k < n; ++k) x[k] = std::sin(1.0 + 2.7 * static_cast<double>(k * k % 97));
  double lambda = 0;
  Matrix6 K_ii, K_ij, K_jj;
  for (int iteration = 0; iteration < 200; ++iteration) {
    x /= x.norm();
    VectorXd force = VectorXd::Zero(n);
    for (const Contact& bond : frame_.contacts) {
      const BondIncrement now(bond, network_.laws()(bond.i, bond.j),
                              {radius_[bond.i], radius_[bond.j], length_, length_},
                              frame_.position[bond.j] - frame_.position[bond.i], Vector6::Zero(), Vector6::Zero());
      now.stiffness(K_ii, K_ij, K_jj);
      const Vector6 x_i = x.segment<6>(6 * bond.i), x_j = x.segment<6>(6 * bond.j);
      force.segment<6>(6 * bond.i) += K_ii * x_i + K_ij * x_j;
      force.segment<6>(6 * bond.j) += K_ij.transpose() * x_i + K_jj * x_j;
    }
    for (Eigen::Index i = 0; i < n; i += 6) force.segment<3>(i + 3) *= length_;
    x = hydrodynamics_->mobility(-force, {}).velocity;
    for (Eigen::Index i = 0; i < n; i += 6) x.segment<3>(i + 3) *= length_;
    const double next = x.norm();
    if (std::abs(next - lambda) < 1e-4 * next) return 2 / next;
    lambda = next;
  }
  return 2 / lambda;
}

void ExplicitEuler::fields(SavedFields& f) {
  Integrator::fields(f);
  f("step", dt_);
  f("stability_limit", limit_);
  std::vector<Vector3> factored_at = hydrodynamics_->factored_at();
  f("factored_at", factored_at);
  if (f.loading()) renew(factored_at);
}

bool ExplicitEuler::step(double latest_time) {
  hydrodynamics_->update(frame_.position);
  const double dt = std::min(dt_, latest_time - frame_.time);
  loads_.setZero(6 * static_cast<Eigen::Index>(radius_.size()));
  network_.add_loads(length_, loads_);
  for (Eigen::Index i = 3; i < loads_.size(); i += 6) loads_.segment<3>(i) *= length_;
  // The flow is at rest where the centre is: else the centre would be carried off, exponentially in a straining flow.
  const Eigen::Matrix3d gradient = gradient_at(frame_.time);
  Vector3 centre = Vector3::Zero();
  for (const Vector3& x : frame_.position) centre += x / static_cast<double>(frame_.position.size());
  increment_ = dt * hydrodynamics_->mobility(-loads_, {-gradient * centre, gradient}).velocity;
  if (!increment_.allFinite())
    throw std::runtime_error(
        fmt::format("step {} at t = {:.6g} s: velocities are not finite (step of {:.3g} s too "
                    "large? the stability limit was {:.3g} s)",
                    frame_.step, frame_.time, dt, limit_));
  for (Eigen::Index i = 3; i < increment_.size(); i += 6) increment_.segment<3>(i) *= length_;
  const double largest = increment_.lpNorm<Eigen::Infinity>();
  if (largest > 0.2 * length_)
    throw std::runtime_error(
        fmt::format("step {} at t = {:.6g} s moves a particle by {:.3g} radii: the explicit "
                    "integrator has become unstable (step {:.3g} s)",
                    frame_.step, frame_.time, largest / length_, dt));
  return move(increment_, dt < dt_ ? latest_time : frame_.time + dt);
}

ExpectedSteps ExplicitEuler::expected_steps(double rigid_strength) const {
  const double most = std::min(protocol_.time_of(2 * rigid_strength), protocol_.end());
  if (std::isinf(most)) return {};
  return {std::min(protocol_.time_of(0.5 * rigid_strength), most) / dt_, most / dt_};
}

}  // namespace crumble::breaker
