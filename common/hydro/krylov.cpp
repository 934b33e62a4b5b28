#include "common/hydro/krylov.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace crumble {

KrylovResult gmres(const LinearOperator& apply, const LinearOperator& precondition, const Eigen::VectorXd& b,
                   double tolerance, int limit) {
  KrylovResult result;
  result.solution = Eigen::VectorXd::Zero(b.size());
  const double beta = b.norm();
  if (beta == 0) {
    result.error = 0;
    result.converged = true;
    return result;
  }
  std::vector<Eigen::VectorXd> basis = {b / beta}, directions;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(limit + 1, limit);
  double target = 30 * tolerance;  // of the residual, sharpened as long as the error is not small enough
  double before = beta;
  for (int k = 0; k < limit; ++k) {
    directions.push_back(precondition(basis.back()));
    Eigen::VectorXd v = apply(directions.back());
    for (int pass = 0; pass < 2; ++pass)  // twice: orthogonal to round-off
      for (int j = 0; j <= k; ++j) {
        const double h = basis[j].dot(v);
        H(j, k) += h;
        v -= h * basis[j];
      }
    H(k + 1, k) = v.norm();
    basis.emplace_back(v / (H(k + 1, k) > 0 ? H(k + 1, k) : 1));
    result.iterations = k + 1;
    const Eigen::MatrixXd small = H.topLeftCorner(k + 2, k + 1);
    const Eigen::VectorXd right = beta * Eigen::VectorXd::Unit(k + 2, 0);
    const Eigen::VectorXd coefficients = small.colPivHouseholderQr().solve(right);
    const Eigen::VectorXd rest = right - small * coefficients;
    const double gain = std::sqrt(std::min(1.0, rest.norm() / before));
    before = rest.norm();
    if (rest.norm() > target * beta && k + 1 < limit) continue;

    result.solution.setZero();
    for (int j = 0; j <= k; ++j) result.solution += coefficients[j] * directions[j];
    Eigen::VectorXd residual = Eigen::VectorXd::Zero(b.size());
    for (int j = 0; j <= k + 1; ++j) residual += rest[j] * basis[j];
    const Eigen::VectorXd correction = precondition(residual);
    result.error = gain * correction.norm() / result.solution.norm();
    result.solution += correction;
    if (result.error <= tolerance) {
      result.converged = true;
      return result;
    }
    target = 0.5 * rest.norm() / beta * tolerance / result.error;
  }
  return result;
}

}  // namespace crumble
