#include "common/hydro/far_field.hpp"

#include <cmath>
#include <numbers>

namespace crumble {

using std::numbers::pi;

namespace {

Eigen::Matrix3d cross_matrix(const Vector3& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

SelfMobility::SelfMobility(double a)
    : force(1 / (6 * pi * a)), torque(1 / (8 * pi * a * a * a)), stresslet(3 / (20 * pi * a * a * a)) {}

PairMobility pair_mobility(const Vector3& r, double a_i, double a_j) {
  constexpr double oseen = 1 / (8 * pi);
  const double inverse = 1 / r.norm(), inverse2 = inverse * inverse, inverse3 = inverse2 * inverse;
  const Vector3 e = r * inverse;
  const auto b = strain_along(e);       // B_k e
  const Vector5 q = b.transpose() * e;  // e . B_k e
  const Eigen::Matrix3d along = e * e.transpose(), across = cross_matrix(e);
  const Eigen::Matrix<double, 3, 5> turning = across * b;  // e x B_k e
  const double a_i2 = a_i * a_i * inverse2, a_j2 = a_j * a_j * inverse2;

  PairMobility m;
  const double c_ff = (a_i2 + a_j2) / 6;
  m.motion_force.topLeftCorner<3, 3>() = oseen * inverse * (1 - 6 * c_ff) * along;
  m.motion_force.topLeftCorner<3, 3>().diagonal().array() += oseen * inverse * (1 + 2 * c_ff);
  m.motion_force.topRightCorner<3, 3>() = -oseen * inverse2 * across;  // T x e
  m.motion_force.bottomLeftCorner<3, 3>() = m.motion_force.topRightCorner<3, 3>();
  m.motion_force.bottomRightCorner<3, 3>() = 1.5 * oseen * inverse3 * along;
  m.motion_force.bottomRightCorner<3, 3>().diagonal().array() -= 0.5 * oseen * inverse3;

  const double c_fs = a_i2 / 6 + a_j2 / 10, c_sf = a_j2 / 6 + a_i2 / 10;
  m.motion_stresslet.topRows<3>() = oseen * inverse2 * (12 * c_fs * b + (3 - 30 * c_fs) * (e * q.transpose()));
  m.motion_stresslet.bottomRows<3>() = -3 * oseen * inverse3 * turning;
  m.strain_force.leftCols<3>() =
      -oseen * inverse2 * (12 * c_sf * b.transpose() + (3 - 30 * c_sf) * (q * e.transpose()));
  m.strain_force.rightCols<3>() = -3 * oseen * inverse3 * turning.transpose();

  const double c_ss = (a_i2 + a_j2) / 10;
  m.strain_stresslet =
      oseen * inverse3 * ((6 - 120 * c_ss) * (b.transpose() * b) + (210 * c_ss - 15) * (q * q.transpose()));
  m.strain_stresslet.diagonal().array() += oseen * inverse3 * 12 * c_ss;
  return m;
}

void assemble_far_field(const Spheres& s, MobilityMatrix& matrix) {
  const int n = s.size(), u0 = 5 * n;
  matrix.spheres = n;
  matrix.interior_per_sphere = 5;
  matrix.lower.resize(11 * n, 11 * n);
  auto& M = matrix.lower;
  for (int j = 0; j < n; ++j) {
    const SelfMobility self(s.radius[j]);
    M.block<5, 5>(5 * j, 5 * j) = Vector5::Constant(self.stresslet).asDiagonal();
    M.block<6, 5>(u0 + 6 * j, 5 * j).setZero();
    M.block<6, 6>(u0 + 6 * j, u0 + 6 * j).setZero();
    M.block<3, 3>(u0 + 6 * j, u0 + 6 * j).diagonal().setConstant(self.force);
    M.block<3, 3>(u0 + 6 * j + 3, u0 + 6 * j + 3).diagonal().setConstant(self.torque);
    for (int i = j + 1; i < n; ++i) {
      const PairMobility m = pair_mobility(s.position[i] - s.position[j], s.radius[i], s.radius[j]);
      M.block<5, 5>(5 * i, 5 * j) = m.strain_stresslet;
      M.block<6, 5>(u0 + 6 * i, 5 * j) = m.motion_stresslet;
      M.block<6, 5>(u0 + 6 * j, 5 * i) = m.strain_force.transpose();
      M.block<6, 6>(u0 + 6 * i, u0 + 6 * j) = m.motion_force;
    }
  }
}

MobilityMatrix far_field_mobility(const Spheres& spheres) {
  MobilityMatrix matrix;
  assemble_far_field(spheres, matrix);
  return matrix;
}

Eigen::Matrix<double, 22, 22> far_field_pair(const Vector3& r, double a_1, double a_2) {
  Eigen::Matrix<double, 22, 22> M = Eigen::Matrix<double, 22, 22>::Zero();
  const double radius[2] = {a_1, a_2};
  for (int k = 0; k < 2; ++k) {
    const SelfMobility self(radius[k]);
    M.block<3, 3>(11 * k, 11 * k).diagonal().setConstant(self.force);
    M.block<3, 3>(11 * k + 3, 11 * k + 3).diagonal().setConstant(self.torque);
    M.block<5, 5>(11 * k + 6, 11 * k + 6).diagonal().setConstant(self.stresslet);
  }
  const PairMobility m = pair_mobility(r, a_2, a_1);
  M.block<6, 6>(11, 0) = m.motion_force;
  M.block<6, 5>(11, 6) = m.motion_stresslet;
  M.block<5, 6>(17, 0) = m.strain_force;
  M.block<5, 5>(17, 6) = m.strain_stresslet;
  M.topRightCorner<11, 11>() = M.bottomLeftCorner<11, 11>().transpose();
  return M;
}

}  // namespace crumble
