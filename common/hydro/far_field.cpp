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

constexpr double oseen = 1 / (8 * pi);

struct PairGeometry {
  double inverse, inverse2, inverse3;  // of the distance
  Vector3 e;
  Eigen::Matrix<double, 3, 5> b;  // B_k e
  Vector5 q;                      // e . B_k e

  explicit PairGeometry(const Vector3& r)
      : inverse(1 / r.norm()),
        inverse2(inverse * inverse),
        inverse3(inverse2 * inverse),
        e(r * inverse),
        b(strain_along(e)),
        q(b.transpose() * e) {}
};

Eigen::Matrix<double, 6, 6> motion_by_force(const PairGeometry& g, double a_i, double a_j) {
  Eigen::Matrix<double, 6, 6> m;
  const Eigen::Matrix3d along = g.e * g.e.transpose();
  const double c = (a_i * a_i + a_j * a_j) * g.inverse2 / 6;
  m.topLeftCorner<3, 3>() = oseen * g.inverse * (1 - 6 * c) * along;
  m.topLeftCorner<3, 3>().diagonal().array() += oseen * g.inverse * (1 + 2 * c);
  m.topRightCorner<3, 3>() = -oseen * g.inverse2 * cross_matrix(g.e);  // T x e
  m.bottomLeftCorner<3, 3>() = m.topRightCorner<3, 3>();
  m.bottomRightCorner<3, 3>() = 1.5 * oseen * g.inverse3 * along;
  m.bottomRightCorner<3, 3>().diagonal().array() -= 0.5 * oseen * g.inverse3;
  return m;
}

Eigen::Matrix<double, 6, 5> motion_by_stresslet(const PairGeometry& g, double a_i, double a_j) {
  Eigen::Matrix<double, 6, 5> m;
  const double c = (a_i * a_i / 6 + a_j * a_j / 10) * g.inverse2;
  m.topRows<3>() = oseen * g.inverse2 * (12 * c * g.b + (3 - 30 * c) * (g.e * g.q.transpose()));
  m.bottomRows<3>() = -3 * oseen * g.inverse3 * (cross_matrix(g.e) * g.b);
  return m;
}

Eigen::Matrix<double, 5, 5> strain_by_stresslet(const PairGeometry& g, double a_i, double a_j) {
  const double c = (a_i * a_i + a_j * a_j) * g.inverse2 / 10;
  Eigen::Matrix<double, 5, 5> m =
      oseen * g.inverse3 * ((6 - 120 * c) * (g.b.transpose() * g.b) + (210 * c - 15) * (g.q * g.q.transpose()));
  m.diagonal().array() += oseen * g.inverse3 * 12 * c;
  return m;
}

}  // namespace

SelfMobility::SelfMobility(double a)
    : force(1 / (6 * pi * a)), torque(1 / (8 * pi * a * a * a)), stresslet(3 / (20 * pi * a * a * a)) {}

PairMobility pair_mobility(const Vector3& r, double a_i, double a_j) {
  const PairGeometry there(r), back(-r);
  return {motion_by_force(there, a_i, a_j), motion_by_stresslet(there, a_i, a_j),
          motion_by_stresslet(back, a_j, a_i).transpose(), strain_by_stresslet(there, a_i, a_j)};
}

void assemble_far_field(const Spheres& s, MobilityMatrix& matrix) {
  const int n = s.size(), u0 = 5 * n;
  matrix.spheres = n;
  matrix.interior_per_sphere = 5;
  matrix.lower.resize(11 * n, 11 * n);
  auto& M = matrix.lower;
  // Column by column, in the order of memory: scattering the transposed term instead of computing it again takes twice
  // as long.
#pragma omp parallel for schedule(dynamic, 4) if (n > 300)
  for (int j = 0; j < n; ++j) {
    const SelfMobility self(s.radius[j]);
    M.block<5, 5>(5 * j, 5 * j) = Vector5::Constant(self.stresslet).asDiagonal();
    M.block<6, 5>(u0 + 6 * j, 5 * j).setZero();
    M.block<6, 6>(u0 + 6 * j, u0 + 6 * j).setZero();
    M.block<3, 3>(u0 + 6 * j, u0 + 6 * j).diagonal().setConstant(self.force);
    M.block<3, 3>(u0 + 6 * j + 3, u0 + 6 * j + 3).diagonal().setConstant(self.torque);
    for (int i = 0; i < j; ++i)
      M.block<6, 5>(u0 + 6 * i, 5 * j) =
          motion_by_stresslet(PairGeometry(s.position[i] - s.position[j]), s.radius[i], s.radius[j]);
    for (int i = j + 1; i < n; ++i) {
      const PairGeometry g(s.position[i] - s.position[j]);
      M.block<5, 5>(5 * i, 5 * j) = strain_by_stresslet(g, s.radius[i], s.radius[j]);
      M.block<6, 5>(u0 + 6 * i, 5 * j) = motion_by_stresslet(g, s.radius[i], s.radius[j]);
      M.block<6, 6>(u0 + 6 * i, u0 + 6 * j) = motion_by_force(g, s.radius[i], s.radius[j]);
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
