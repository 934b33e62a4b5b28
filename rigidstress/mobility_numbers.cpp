#include "rigidstress/mobility_numbers.hpp"

#include <numbers>

namespace crumble::rigidstress {

namespace {

Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& m) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(0.5 * (m + m.transpose()), Eigen::EigenvaluesOnly)
      .eigenvalues();
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

MobilityNumbers mobility_numbers(const Eigen::Matrix<double, 6, 6>& drag) {
  MobilityNumbers n;
  n.drag = eigenvalues(drag.topLeftCorner<3, 3>());
  n.rotation = eigenvalues(drag.bottomRightCorner<3, 3>());
  // Equilibrated, since translation and rotation differ by a length squared.
  const Eigen::Matrix<double, 6, 1> s = drag.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix<double, 6, 6> scaled = s.asDiagonal() * drag * s.asDiagonal();
  const Eigen::Matrix<double, 6, 6> mobility = s.asDiagonal() * scaled.inverse() * s.asDiagonal();
  const Eigen::Matrix3d U_F = mobility.topLeftCorner<3, 3>(), W_F = mobility.bottomLeftCorner<3, 3>(),
                        W_T = mobility.bottomRightCorner<3, 3>();
  // About a point r away: velocity U + Omega x r, and a force there has the torque r x F:
  //   U_F' = U_F - [r] W_F + W_F^T [r] - [r] W_T [r],  W_F' = W_F + W_T [r]
  // W_F' is symmetric where (tr(W_T) - W_T) r = axial(W_F), axial(W)_k = eps_kij W_ij.
  const Eigen::Vector3d axial(W_F(1, 2) - W_F(2, 1), W_F(2, 0) - W_F(0, 2), W_F(0, 1) - W_F(1, 0));
  const Eigen::Matrix3d A = W_T.trace() * Eigen::Matrix3d::Identity() - W_T;
  const Eigen::Matrix3d X = cross_matrix(A.ldlt().solve(axial));
  const Eigen::Matrix3d moved = U_F - X * W_F + W_F.transpose() * X - X * W_T * X;
  n.hydrodynamic_radius = 3 / (6 * std::numbers::pi * moved.trace());
  return n;
}

}  // namespace crumble::rigidstress
