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
    : Hydrodynamics(spheres, viscosity), model_(model), settings_(settings) {
  if (model.rung == Rung::multipole)
    throw std::invalid_argument("lagged hydrodynamics is for the far-field rungs, not for multipoles");
  lubrication_ = lubrication(reduced(), model_);
  far_field_.emplace(reduced());
  refresh();
}

void LaggedHydrodynamics::update(const std::vector<Vector3>& position) {
  move(position);
  lubrication_ = lubrication(reduced(), model_);
  far_field_.emplace(reduced());
}

void LaggedHydrodynamics::refresh() const {
  ++work_.factorisations;
  const Eigen::SparseMatrix<double> near = lubrication_.motion_resistance(size());
  if (settings_.single_precision)
    factor_.emplace<ConstrainedFactor<float>>(far_field_mobility(reduced()), near);
  else
    factor_.emplace<ConstrainedFactor<double>>(far_field_mobility(reduced()), near);
}

Eigen::VectorXd LaggedHydrodynamics::product(const Eigen::VectorXd& f) const {
  ++work_.products;
  Eigen::VectorXd w(f.size());
  far_field_->apply(f.data(), w.data());
  return w;
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

Eigen::VectorXd LaggedHydrodynamics::precondition_mobility(const Eigen::VectorXd& r) const {
  return with_factor(r, [](const auto& factor, auto& x) { factor.solve_mobility(x, nullptr); });
}

Eigen::VectorXd LaggedHydrodynamics::precondition_resistance(const Eigen::VectorXd& r) const {
  return with_factor(r, [](const auto& factor, auto& x) { factor.solve_resistance(x); });
}

// A factor that has become too old is renewed once; a solve that fails with a fresh one is an error.
template <class Apply, class Precondition>
Eigen::VectorXd LaggedHydrodynamics::solve(const Apply& apply, const Precondition& precondition,
                                           const Eigen::VectorXd& b) const {
  KrylovResult result = gmres(apply, precondition, b, settings_.tolerance, settings_.refresh_after);
  work_.iterations = result.iterations;
  if (!result.converged) {
    refresh();
    result = gmres(apply, precondition, b, settings_.tolerance, iteration_limit);
    work_.iterations += result.iterations;
  }
  if (!result.converged)
    throw std::runtime_error(fmt::format("hydrodynamics did not converge: error {:.3g} after {} iterations",
                                         result.error, result.iterations));
  return result.solution;
}

void LaggedHydrodynamics::solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain,
                                           Eigen::MatrixXd& q_motion, Eigen::MatrixXd& q_strain) const {
  const int n = size();
  q_motion.resize(6 * n, w_motion.cols());
  q_strain.resize(5 * n, w_motion.cols());
  for (Eigen::Index c = 0; c < w_motion.cols(); ++c) {
    Eigen::VectorXd w(11 * n);
    w << w_strain.col(c), w_motion.col(c);
    const Eigen::VectorXd f = solve([&](const Eigen::VectorXd& v) { return product(v); },
                                    [&](const Eigen::VectorXd& v) { return precondition_resistance(v); }, w);
    q_strain.col(c) = f.head(5 * n);
    q_motion.col(c) = f.tail(6 * n);
  }
  lubrication_.add(w_motion, w_strain, q_motion, q_strain);
}

void LaggedHydrodynamics::solve_mobility(const Eigen::MatrixXd& q_motion, const Eigen::MatrixXd& w_strain,
                                         Eigen::MatrixXd& w_motion, Eigen::MatrixXd& q_strain) const {
  const int n = size();
  const Eigen::MatrixXd at_rest = Eigen::MatrixXd::Zero(6 * n, q_motion.cols()), none = Eigen::MatrixXd::Zero(5 * n, 1);
  Eigen::MatrixXd by_strain = at_rest, stresslet = Eigen::MatrixXd::Zero(5 * n, q_motion.cols());
  lubrication_.add(at_rest, w_strain, by_strain, stresslet);
  w_motion.resize(6 * n, q_motion.cols());
  q_strain.resize(5 * n, q_motion.cols());
  const auto apply = [&](const Eigen::VectorXd& f) {
    Eigen::VectorXd w = product(f);
    const Eigen::MatrixXd u = w.tail(6 * n);
    Eigen::MatrixXd loads = f.tail(6 * n), unused = Eigen::MatrixXd::Zero(5 * n, 1);
    lubrication_.add(u, none, loads, unused);
    w.tail(6 * n) = loads;
    return w;
  };
  for (Eigen::Index c = 0; c < q_motion.cols(); ++c) {
    Eigen::VectorXd b(11 * n);
    b << w_strain.col(c), q_motion.col(c) - by_strain.col(c);
    const Eigen::VectorXd f = solve(
        apply, [&](const Eigen::VectorXd& v) { return precondition_mobility(v); }, b);
    w_motion.col(c) = product(f).tail(6 * n);
    q_strain.col(c) = f.head(5 * n);
  }
  lubrication_.add(w_motion, w_strain, by_strain, q_strain);
}

}  // namespace crumble
