#include "common/hydro/rigid_body.hpp"

namespace crumble {

namespace {

Eigen::Matrix3d cross_matrix(const Vector3& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// Columns: the velocities of all spheres in unit translations and rotations of the body about its centre. Its transpose
// sums sphere loads to the body's force and torque.
Eigen::MatrixXd rigid_motions(const std::vector<Vector3>& position, const Vector3& centre) {
  const auto n = static_cast<Eigen::Index>(position.size());
  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(6 * n, 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    Z.block<6, 6>(6 * i, 0).setIdentity();
    Z.block<3, 3>(6 * i, 3) = -cross_matrix(position[i] - centre);
  }
  return Z;
}

}  // namespace

Eigen::Matrix<double, 6, 1> RigidBodyResponse::motion(const LinearFlow& flow) const {
  Eigen::Matrix<double, 6, 1> ambient;
  ambient << flow.velocity_at(centre), flow.angular_velocity();
  return ambient + drift * flow.strain();
}

void RigidBodyResponse::fields(SavedFields& f) {
  f("centre", centre);
  f("motion_loads", motion_loads);
  f("strain_loads", strain_loads);
  f("drag", drag);
  f("strain_drag", strain_drag);
  f("drift", drift);
  f("free_loads", free_loads);
}

RigidBodyResponse rigid_body_response(const Hydrodynamics& hydrodynamics, const std::vector<Vector3>& position,
                                      const Vector3& centre) {
  const Eigen::MatrixXd Z = rigid_motions(position, centre);
  Eigen::MatrixXd velocity = Eigen::MatrixXd::Zero(Z.rows(), 11), strain = Eigen::MatrixXd::Zero(5, 11);
  velocity.leftCols<6>() = Z;
  strain.rightCols<5>().setIdentity();
  for (std::size_t i = 0; i < position.size(); ++i)
    velocity.block<3, 5>(6 * static_cast<Eigen::Index>(i), 6) = -strain_along(position[i] - centre);

  const Eigen::MatrixXd loads = hydrodynamics.relative_resistance(velocity, strain).force_torque;
  RigidBodyResponse r;
  r.centre = centre;
  r.motion_loads = loads.leftCols<6>();
  r.strain_loads = loads.rightCols<5>();
  r.drag = -Z.transpose() * r.motion_loads;
  r.strain_drag = Z.transpose() * r.strain_loads;
  // Equilibrated: force and torque entries differ by a length squared, which in metres would spoil the 6 x 6 solve.
  const Eigen::Matrix<double, 6, 1> s = r.drag.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix<double, 6, 6> K = s.asDiagonal() * r.drag * s.asDiagonal();
  r.drift = s.asDiagonal() * K.llt().solve(s.asDiagonal() * r.strain_drag);
  r.free_loads = r.strain_loads + r.motion_loads * r.drift;
  return r;
}

}  // namespace crumble
