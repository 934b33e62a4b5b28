#include "common/agglomerate/bond.hpp"

#include <gtest/gtest.h>

using namespace crumble;
using Eigen::AngleAxisd;

namespace {

constexpr double a = 10e-9;

struct PairOfSpheres {
  BondLaw law{ContactChoice{}, Material{}, a, a};
  Vector3 x_i = Vector3::Zero(), x_j;
  Contact bond;

  explicit PairOfSpheres(const Vector3& direction = Vector3::UnitX())
      : x_j(direction.normalized() * (2 * a + law.equilibrium_gap())), bond(make_bond(law, 0, 1, x_j, a, a, 0)) {}

  void move(const Vector3& dx_i, const Vector3& dx_j, const Vector3& dW_i, const Vector3& dW_j) {
    x_i += dx_i;
    x_j += dx_j;
    advance(bond, law, {x_j - x_i, dx_j - dx_i, dW_i, dW_j, a, a});
  }
};

TEST(Bond, rigid_motion_of_the_pair_changes_no_load_and_turns_what_it_remembers) {
  PairOfSpheres pair(Vector3(1, 2, 3));
  // Some elastic load in every spring, then a full turn about a skew axis through a point off the pair, plus a shift.
  const Vector3 n = pair.bond.normal, t = n.cross(Vector3::UnitZ()).normalized();
  pair.move(Vector3::Zero(), 0.01e-9 * n + 0.02e-9 * t, 1e-3 * t + 2e-3 * n, -2e-3 * t);
  ASSERT_EQ(pair.bond.at_limit, 0);
  const Contact before = pair.bond;
  const Vector3 axis = Vector3(0.3, -1, 0.5).normalized(), centre(50e-9, 10e-9, -20e-9);
  const int steps = 2000;
  const AngleAxisd turn(2 * std::numbers::pi / steps, axis);
  for (int k = 0; k < steps; ++k) {
    const auto shift = [&](const Vector3& x) -> Vector3 {
      return turn * (x - centre) + centre - x + Vector3(1e-12, 0, 0);
    };
    const Vector3 dW = turn.angle() * axis;
    pair.move(shift(pair.x_i), shift(pair.x_j), dW, dW);
  }
  EXPECT_NEAR(pair.bond.normal_force / before.normal_force, 1, 1e-9);
  // Each step takes the chord of the motion for its arc: alpha^3/24 of the distance of centres, at most.
  const double alpha = 2 * std::numbers::pi / steps, chord_error = steps * alpha * alpha * alpha / 24 * 2 * a;
  EXPECT_LT((pair.bond.sliding_force - before.sliding_force).norm(), pair.law.k_s * chord_error);
  EXPECT_LT((pair.bond.rolling_torque - before.rolling_torque).norm(), 1e-4 * before.rolling_torque.norm());
  EXPECT_NEAR(pair.bond.twisting_torque / before.twisting_torque, 1, 1e-9);
}

TEST(Bond, forces_and_torques_on_the_two_spheres_balance) {
  PairOfSpheres pair(Vector3(-1, 0.3, 0.7));
  pair.move(Vector3(0.01e-9, 0, 0), Vector3(0, 0.02e-9, -0.01e-9), Vector3(1e-3, 2e-3, 0), Vector3(0, -1e-3, 3e-3));
  const double l = lever_arm(pair.bond, a, a);
  EXPECT_NEAR(2 * l, (pair.x_j - pair.x_i).norm(), 1e-22);
  const Vector3 torque =
      torque_on_i(pair.bond, l) + torque_on_j(pair.bond, l) + (pair.x_j - pair.x_i).cross(force_on_j(pair.bond));
  EXPECT_LT(torque.norm(), 1e-14 * l * force_on_j(pair.bond).norm());
}

TEST(Bond, loads_oppose_the_motion_that_made_them) {
  PairOfSpheres pair;
  pair.move(Vector3::Zero(), Vector3(1e-12, 2e-12, 0), Vector3::Zero(), Vector3(1e-3, 0, 2e-3));
  EXPECT_LT(force_on_j(pair.bond).x(), 0);      // pulled apart: pulled back
  EXPECT_LT(torque_on_j(pair.bond, a).x(), 0);  // twisted
  EXPECT_LT(pair.bond.rolling_torque.z(), 0);   // rolled
  // Sliding of the surface of j: +2e-12 from the shift, -l 2e-3 = -2e-11 from its rotation; the force is along +y.
  EXPECT_GT(pair.bond.sliding_force.y(), 0);
}

TEST(Bond, rolling_yields_at_its_limit_and_turns_back_at_once) {
  PairOfSpheres pair;
  const Vector3 dW(0, 0, 1e-3);
  for (int k = 0; k < 300; ++k) pair.move(Vector3::Zero(), Vector3::Zero(), -dW, dW);  // gears: rolling, no sliding
  EXPECT_EQ(pair.bond.at_limit, 4);
  EXPECT_NEAR(pair.bond.rolling_torque.norm() / pair.law.M_r_crit, 1, 1e-12);
  EXPECT_LT(pair.bond.sliding_force.norm(), 1e-12 * pair.law.F_s_crit);
  pair.move(Vector3::Zero(), Vector3::Zero(), dW, -dW);
  EXPECT_EQ(pair.bond.at_limit, 0);
  EXPECT_NEAR(pair.bond.rolling_torque.norm(), pair.law.M_r_crit - 2e-3 * pair.law.k_r, 1e-9 * pair.law.M_r_crit);
}

TEST(Bond, sliding_and_twisting_yield_at_their_limits) {
  PairOfSpheres pair;
  for (int k = 0; k < 200; ++k) pair.move(Vector3::Zero(), Vector3::Zero(), Vector3(1e-3, 0, 0), Vector3(-1e-3, 0, 0));
  EXPECT_EQ(pair.bond.at_limit, 2);
  EXPECT_NEAR(std::abs(pair.bond.twisting_torque) / pair.law.M_t_crit, 1, 1e-12);
  for (int k = 0; k < 200; ++k) pair.move(Vector3::Zero(), Vector3::Zero(), Vector3(0, 0, 1e-3), Vector3(0, 0, 1e-3));
  EXPECT_TRUE(pair.bond.at_limit & 1);
  EXPECT_NEAR(pair.bond.sliding_force.norm() / pair.law.F_s_crit, 1, 1e-12);
}

TEST(Bond, of_coincident_centres_is_an_error_that_names_the_pair) {
  const BondLaw law(ContactChoice{}, Material{}, a, a);
  try {
    make_bond(law, 3, 8, Vector3::Zero(), a, a, 0);
    FAIL() << "no error";
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("3-8"), std::string::npos) << error.what();
  }
}

}  // namespace
