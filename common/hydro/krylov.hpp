// Flexible GMRES for the few iterations that a good preconditioner leaves.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace crumble {

struct KrylovResult {
  Eigen::VectorXd solution;
  int iterations = 0;  // products with A
  double error = 1;    // estimate of |x - exact| / |x|
  bool converged = false;
};

// Solves A x = b to an error of tolerance |x|. With P close to A the error is P^-1 (b - A x), which a small residual
// does not bound when A has soft and stiff directions; it is added to x, and what remains is smaller by about the
// square root of what the last iteration gained (measured on clusters of 85 to 500 spheres; the gain itself promises
// too much). apply(v) returns A v, precondition(v) about A^-1 v; as the residual is that of A, the preconditioner may
// be as inexact as float32. No restart: memory is 2 limit vectors.
using LinearOperator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
KrylovResult gmres(const LinearOperator& apply, const LinearOperator& precondition, const Eigen::VectorXd& b,
                   double tolerance, int limit);

}  // namespace crumble
