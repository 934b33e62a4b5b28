// The five-dimensional space of symmetric traceless tensors (rate of strain E, stresslet S) in an orthonormal basis.
//
//   E = sum_k e_k B_k,   B_k : B_l = delta_kl,   so that S : E = s . e and every resistance matrix is symmetric.
//
//   B_0 = (xy + yx)/sqrt 2,  B_1 = (yz + zy)/sqrt 2,  B_2 = (2 zz - xx - yy)/sqrt 6,
//   B_3 = (zx + xz)/sqrt 2,  B_4 = (xx - yy)/sqrt 2
//
// which is the order m = -2 ... 2 of the real spherical harmonics of degree 2.
#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace crumble {

using Vector5 = Eigen::Matrix<double, 5, 1>;

inline Eigen::Matrix3d strain_tensor(const Vector5& e) {
  const double h = std::sqrt(0.5), s = 1 / std::sqrt(6.0);
  Eigen::Matrix3d E;
  E << h * e[4] - s * e[2], h * e[0], h * e[3],  //
      h * e[0], -h * e[4] - s * e[2], h * e[1],  //
      h * e[3], h * e[1], 2 * s * e[2];
  return E;
}

// Components of the symmetric traceless part of a tensor; the rest is dropped.
inline Vector5 strain_components(const Eigen::Matrix3d& A) {
  const double h = std::sqrt(0.5), s = 1 / std::sqrt(6.0);
  return {h * (A(0, 1) + A(1, 0)), h * (A(1, 2) + A(2, 1)), s * (2 * A(2, 2) - A(0, 0) - A(1, 1)),
          h * (A(0, 2) + A(2, 0)), h * (A(0, 0) - A(1, 1))};
}

// Columns b_k = B_k e for a vector e: the strain basis seen along e.
inline Eigen::Matrix<double, 3, 5> strain_along(const Eigen::Vector3d& e) {
  const double h = std::sqrt(0.5), s = 1 / std::sqrt(6.0);
  Eigen::Matrix<double, 3, 5> b;
  b << h * e[1], 0, -s * e[0], h * e[2], h * e[0],  //
      h * e[0], h * e[2], -s * e[1], 0, -h * e[1],  //
      0, h * e[1], 2 * s * e[2], h * e[0], 0;
  return b;
}

}  // namespace crumble
