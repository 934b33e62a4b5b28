#include "common/hydro/lagged_hydrodynamics.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "common/hydro/krylov.hpp"

namespace crumble {

namespace {
constexpr int iteration_limit = 60;
}

LaggedHydrodynamics::LaggedHydrodynamics(const Spheres& spheres, double viscosity, const HydroModel& model,
                                         const LaggedSettings& settings)
    : IterativeHydrodynamics(spheres, viscosity, model), settings_(settings), position_(spheres.position) {
  refresh();
}

void LaggedHydrodynamics::update(const std::vector<Vector3>& position) {
  position_ = position;
  follow(position);
}

void LaggedHydrodynamics::refresh() const {
  ++factorisations_;
  factored_at_ = position_;
  const Eigen::SparseMatrix<double> near = pair_lubrication().motion_resistance(size());
  if (settings_.single_precision)
    factor_.emplace<ConstrainedFactor<float>>(far_field_mobility(reduced()), near);
  else
    factor_.emplace<ConstrainedFactor<double>>(far_field_mobility(reduced()), near);
}

// The lagged factor works on its own precision.
template <class Solve>
Eigen::VectorXd LaggedHydrodynamics::with_factor(const Eigen::VectorXd& r, const Solve& solve) const {
  const auto on = [&](const auto& factor) -> Eigen::VectorXd {
    using Matrix = typename std::decay_t<decltype(factor)>::Matrix;
    Matrix x = r.template cast<typename Matrix::Scalar>();
    solve(factor, x);
    return x.template cast<double>();
  };
  if (const auto* single = std::get_if<ConstrainedFactor<float>>(&factor_)) return on(*single);
  return on(std::get<ConstrainedFactor<double>>(factor_));
}

// A factor that has become too old is renewed once; a solve that fails with a fresh one is an error.
Eigen::VectorXd LaggedHydrodynamics::solve(const Operator& apply, const Operator& precondition,
                                           const Eigen::VectorXd& b) const {
  KrylovResult result = gmres(apply, precondition, b, settings_.tolerance, settings_.refresh_after);
  iterations_ = result.iterations;
  if (!result.converged) {
    refresh();
    result = gmres(apply, precondition, b, settings_.tolerance, iteration_limit);
    iterations_ += result.iterations;
  }
  if (!result.converged)
    throw std::runtime_error(fmt::format("hydrodynamics did not converge: error {:.3g} after {} iterations",
                                         result.error, result.iterations));
  return result.solution;
}

Eigen::VectorXd LaggedHydrodynamics::solve_far_field(const Operator& mobility, const Eigen::VectorXd& w) const {
  const auto precondition = [this](const Eigen::VectorXd& r) {
    return with_factor(r, [](const auto& factor, auto& x) { factor.solve_resistance(x); });
  };
  return solve(mobility, precondition, w);
}

Eigen::VectorXd LaggedHydrodynamics::solve_saddle(const Operator& saddle, const Eigen::VectorXd& b) const {
  const auto precondition = [this](const Eigen::VectorXd& r) {
    return with_factor(r, [](const auto& factor, auto& x) { factor.solve_mobility(x, nullptr); });
  };
  return solve(saddle, precondition, b);
}

}  // namespace crumble
