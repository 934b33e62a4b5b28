#include "common/contact/kinematics.hpp"

#include <gtest/gtest.h>

using namespace crumble;
using Eigen::AngleAxisd;
using Eigen::Vector3d;

namespace {

TEST(Kinematics, rigid_motion_of_a_pair_has_no_relative_motion) {
  const Vector3d n = Vector3d(1, 2, -0.5).normalized(), v(0.3, -1, 2), W(0.7, 0.1, -1.9);
  const double l_i = 1.3, l_j = 0.6;
  const auto m = relative_motion(n, W.cross((l_i + l_j) * n), W, W, l_i, l_j);
  EXPECT_LT(m.sliding.norm(), 1e-15);
  EXPECT_LT(m.rolling.norm(), 1e-15);
  EXPECT_EQ(m.twisting, 0);
}

TEST(Kinematics, gears_roll_without_sliding_and_a_spinning_pair_slides_without_rolling) {
  const Vector3d n = Vector3d::UnitX(), W = Vector3d::UnitZ();
  const auto gears = relative_motion(n, Vector3d::Zero(), W, -W, 1, 1);
  EXPECT_LT(gears.sliding.norm(), 1e-15);
  EXPECT_NEAR(gears.rolling.z(), -2, 1e-15);
  const auto spinning = relative_motion(n, Vector3d::Zero(), W, W, 1, 1);
  EXPECT_LT(spinning.rolling.norm(), 1e-15);
  // Surface of i at the contact moves along +y, that of j along -y: j slides past i along -y.
  EXPECT_NEAR(spinning.sliding.y(), -2, 1e-15);
}

TEST(Kinematics, the_sliding_force_leaves_no_net_torque_on_the_pair) {
  const Vector3d n = Vector3d(0.2, 1, 0.4).normalized(), F = n.cross(Vector3d::UnitX());
  const double l_i = 0.8, l_j = 2.1;
  // F acts on j and -F on i, both at the contact point.
  const Vector3d torque = (l_i * n).cross(-F) + (-l_j * n).cross(F) + ((l_i + l_j) * n).cross(F);
  EXPECT_LT(torque.norm(), 1e-15);
}

TEST(FrameRotation, carries_a_history_through_a_rigid_rotation_about_any_axis) {
  const Vector3d axis = Vector3d(1, -0.4, 0.3).normalized();
  const Vector3d n = Vector3d(0.1, 0.9, 0.2).normalized();
  const Vector3d xi = n.cross(Vector3d::UnitZ()) * 1e-3;
  double previous_error = 0;
  for (const double angle : {0.02, 0.01}) {
    const AngleAxisd R(angle, axis);
    const Vector3d n_new = R * n;
    Vector3d moved = xi;
    // The spin seen by the spheres: the rotation vector resolved along the mean normal.
    FrameRotation(n, n_new, angle * axis.dot((n + n_new).normalized())).apply(moved);
    const double error = (moved - R * xi).norm() / xi.norm();
    EXPECT_LT(error, 0.2 * angle * angle * angle);
    if (previous_error > 0) {
      EXPECT_GT(previous_error / error, 7);  // third order in the angle of one step
    }
    previous_error = error;
    EXPECT_NEAR(moved.dot(n_new), 0, 1e-18);
    EXPECT_NEAR(moved.norm() / xi.norm(), 1, 1e-12);
  }
}

}  // namespace
