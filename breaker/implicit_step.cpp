#include "breaker/implicit_step.hpp"

#include <cmath>

#include "common/hydro/dense_kernels.hpp"

namespace crumble::breaker {

using Eigen::VectorXd;

ImplicitStep::ImplicitStep(const std::vector<double>& radius, double length, const BondLaws& laws,
                           const SurfacePairs* surface_pairs)
    : radius_(radius), length_(length), laws_(laws), surface_pairs_(surface_pairs) {}

BondEnds ImplicitStep::ends(const Contact& bond) const { return {radius_[bond.i], radius_[bond.j], length_, length_}; }

BondIncrement ImplicitStep::increment(const Frame& frame, const Contact& bond, const VectorXd& q) const {
  return {bond,
          laws_(bond.i, bond.j),
          ends(bond),
          frame.position[bond.j] - frame.position[bond.i],
          q.segment<6>(6 * bond.i),
          q.segment<6>(6 * bond.j)};
}

void ImplicitStep::foresee(const Frame& frame, const VectorXd& q) {
  bonds_.clear();
  for (const Contact& bond : frame.contacts)
    bonds_.push_back(foreseen(bond, laws_(bond.i, bond.j), ends(bond), frame.position[bond.j] - frame.position[bond.i],
                              q.segment<6>(6 * bond.i), q.segment<6>(6 * bond.j)));
}

double ImplicitStep::bond_energy(const Frame& frame, const VectorXd& q) const {
  double energy = 0;
  for (const Contact& bond : bonds_) energy += increment(frame, bond, q).energy();
  if (surface_pairs_) energy += surface_pairs_->energy(frame, q);
  return energy;
}

void ImplicitStep::set_gradient(const Frame& frame, const Problem& problem, const VectorXd& q) {
  gradient_ = problem.drag * dragged_ - problem.load;
  Vector6 g_i, g_j;
  for (const Contact& bond : bonds_) {
    g_i.setZero();
    g_j.setZero();
    increment(frame, bond, q).add_gradient(g_i, g_j);
    gradient_.segment<6>(6 * bond.i) += g_i;
    gradient_.segment<6>(6 * bond.j) += g_j;
  }
  if (surface_pairs_) surface_pairs_->add_gradient(frame, q, gradient_);
}

bool ImplicitStep::factorise(const Frame& frame, const Problem& problem, const VectorXd& q, Curvature curvature) {
  matrix_ = problem.drag * problem.resistance;
  Matrix6 K_ii, K_ij, K_jj;
  for (const Contact& bond : bonds_) {
    increment(frame, bond, q).stiffness(K_ii, K_ij, K_jj, curvature);
    matrix_.block<6, 6>(6 * bond.i, 6 * bond.i) += K_ii;
    matrix_.block<6, 6>(6 * bond.j, 6 * bond.j) += K_jj;
    matrix_.block<6, 6>(6 * bond.j, 6 * bond.i) += K_ij.transpose();  // i < j: the lower triangle
  }
  if (surface_pairs_) surface_pairs_->add_stiffness(frame, q, curvature, matrix_);
  return dense::cholesky<double>(matrix_) == 0;
}

ImplicitStep::Outcome ImplicitStep::solve(const Frame& frame, const Problem& problem, double tolerance, VectorXd& q) {
  Outcome outcome;
  foresee(frame, q);
  dragged_.noalias() = problem.resistance * q;
  double bonds = bond_energy(frame, q);
  // What cancels inside the energy of a bond is of the order of its work of separation.
  double noise = 0;
  for (const Contact& bond : bonds_) {
    const BondLaw& law = laws_(bond.i, bond.j);
    noise += 1e-14 * law.pull_off_force() * law.jkr.length;
  }
  if (surface_pairs_) noise += 1e-14 * std::abs(surface_pairs_->energy(frame, q));
  // The factor of an earlier iteration goes downhill as well, and its solves cost an eighth of a new one (order 690).
  constexpr double contraction = 0.1;
  bool renew = true;
  double before = 0;
  for (outcome.iterations = 1; outcome.iterations <= 50; ++outcome.iterations) {
    set_gradient(frame, problem, q);
    if (renew) {
      ++outcome.factorisations;
      if (!factorise(frame, problem, q, Curvature::full)) {
        ++outcome.factorisations;  // not convex here: go downhill by the part that always is
        if (!factorise(frame, problem, q, Curvature::convex)) return outcome;
      }
    }
    correction_ = -gradient_;
    matrix_.triangularView<Eigen::Lower>().solveInPlace(correction_);
    matrix_.triangularView<Eigen::Lower>().transpose().solveInPlace(correction_);
    const double slope = -gradient_.dot(correction_);
    if (!std::isfinite(slope)) return outcome;
    dragged_correction_.noalias() = problem.resistance * correction_;

    // Differences of the energy: the parts are far larger than what the last corrections change.
    const double linear = problem.drag * dragged_.dot(correction_) - problem.load.dot(correction_);
    const double quadratic = 0.5 * problem.drag * dragged_correction_.dot(correction_);
    const double size = correction_.lpNorm<Eigen::Infinity>();
    const bool last = size < tolerance;  // below what the energy resolves
    double fraction = 1, next = bonds;
    for (int halving = 0; halving < 30; ++halving, fraction /= 2) {
      trial_ = q + fraction * correction_;
      next = bond_energy(frame, trial_);
      const double change = fraction * (linear + fraction * quadratic) + next - bonds;
      if (last || change <= -1e-4 * fraction * slope + noise + 1e-14 * (std::abs(bonds) + std::abs(next))) break;
    }
    q.swap(trial_);
    dragged_ += fraction * dragged_correction_;
    bonds = next;
    if (last) {
      outcome.converged = true;
      return outcome;
    }
    renew = fraction < 1 || (!renew && size > contraction * before);
    before = size;
  }
  return outcome;
}

}  // namespace crumble::breaker
