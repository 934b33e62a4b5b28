// Inverse of a symmetric positive definite matrix from its Cholesky factor, at a third of the cost of solving for the
// columns of the identity.
#pragma once

#include <Eigen/Dense>

namespace crumble {

namespace triangular {

using Block = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
inline constexpr Eigen::Index smallest_block = 64;

// L <- L^-1, halves at a time: [A 0; B C]^-1 = [A^-1 0; -C^-1 B A^-1  C^-1]. The upper triangle is not touched.
inline void invert(Block L) {
  const Eigen::Index n = L.rows();
  if (n <= smallest_block) {
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(n, n);
    L.triangularView<Eigen::Lower>().solveInPlace(inverse);
    L.triangularView<Eigen::Lower>() = inverse;
    return;
  }
  const Eigen::Index h = n / 2, k = n - h;
  invert(L.topLeftCorner(h, h));
  invert(L.bottomRightCorner(k, k));
  const Eigen::MatrixXd right = L.bottomLeftCorner(k, h) * L.topLeftCorner(h, h).triangularView<Eigen::Lower>();
  L.bottomLeftCorner(k, h).noalias() = -(L.bottomRightCorner(k, k).triangularView<Eigen::Lower>() * right);
}

// The lower triangle of L^T L in place of L: [A^T A + B^T B  .; C^T B  C^T C].
inline void square(Block L) {
  const Eigen::Index n = L.rows();
  if (n <= smallest_block) {
    const Eigen::MatrixXd lower = L.triangularView<Eigen::Lower>();
    L.triangularView<Eigen::Lower>() = lower.transpose() * lower;
    return;
  }
  const Eigen::Index h = n / 2, k = n - h;
  square(L.topLeftCorner(h, h));
  L.topLeftCorner(h, h).selfadjointView<Eigen::Lower>().rankUpdate(L.bottomLeftCorner(k, h).transpose());
  L.bottomLeftCorner(k, h) =
      (L.bottomRightCorner(k, k).triangularView<Eigen::Lower>().transpose() * L.bottomLeftCorner(k, h)).eval();
  square(L.bottomRightCorner(k, k));
}

}  // namespace triangular

// (L L^T)^-1, both triangles, from the lower triangle L.
inline Eigen::MatrixXd inverse_from_factor(Eigen::MatrixXd L) {
  triangular::invert(L);
  triangular::square(L);
  L.triangularView<Eigen::StrictlyUpper>() = L.transpose();
  return L;
}

}  // namespace crumble
