// Points moved onto given distances.
#pragma once

#include <cstddef>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble {

struct Link {
  std::size_t i, j;
  double distance;  // wanted between points i and j
};

struct Projected {
  int iterations = 0;
  bool converged = true;  // the residual is at round-off, or no short move lessens it by much
};

// Moves the points until |x_j - x_i| = distance for every link, by Gauss-Newton steps of least norm, damped
// (Levenberg-Marquardt) where they are long:
//     dx = -J^T (J J^T + lambda)^-1 C,     C = |x_j - x_i| - distance,  J = dC/dx,  sparse Cholesky over the links
// Where the links cannot all be met the sum of squares of C becomes least as far as short moves can make it. Lengths
// should be of the order of 1 and the points around the origin. Throws std::invalid_argument for linked points that
// coincide.
Projected project(const std::vector<Link>& links, std::vector<Vector3>& x);

}  // namespace crumble
