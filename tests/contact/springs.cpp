#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "common/contact/cundall_strack.hpp"
#include "common/contact/plastic_spring.hpp"

using namespace crumble;
using Eigen::Vector3d;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(PlasticSpring, is_elastic_below_its_limit) {
  Vector3d xi(3e-12, 4e-12, 0);
  EXPECT_FALSE(yield(xi, 2.0, 1.1e-11));
  EXPECT_EQ(xi, Vector3d(3e-12, 4e-12, 0));
}

TEST(PlasticSpring, caps_the_magnitude_and_keeps_the_direction) {
  Vector3d xi(3e-12, 4e-12, 0);
  EXPECT_TRUE(yield(xi, 2.0, 5e-12));
  EXPECT_NEAR(xi.norm() * 2.0, 5e-12, 1e-27);
  EXPECT_NEAR(xi.x() / xi.y(), 0.75, 1e-15);
}

TEST(PlasticSpring, does_not_wind_up) {
  double angle = 0;
  for (int step = 0; step < 1000; ++step) {
    angle += 1e-3;
    yield(angle, 10.0, 0.05);
  }
  // After any amount of yielding the torque drops with the elastic slope at once when the motion turns.
  EXPECT_NEAR(10.0 * angle, 0.05, 1e-15);
  angle -= 2e-3;
  EXPECT_FALSE(yield(angle, 10.0, 0.05));
  EXPECT_NEAR(10.0 * angle, 0.03, 1e-15);
}

TEST(PlasticSpring, unlimited_and_absent_springs_are_limits_of_the_same_law) {
  double x = 1e3;
  EXPECT_FALSE(yield(x, 5.0, infinite));
  EXPECT_TRUE(yield(x, 5.0, 0.0));
  EXPECT_EQ(x, 0);
  EXPECT_FALSE(yield(x, 0.0, 0.0));
}

TEST(PlasticSpring, capped_force_is_the_derivative_of_the_capped_energy) {
  const double k = 3, limit = 0.6, d = 1e-6;
  for (double xi = 0.01; xi < 0.5; xi += 0.0137) {
    double stored = xi;
    yield(stored, k, limit);
    EXPECT_NEAR((capped_energy(xi + d, k, limit) - capped_energy(xi - d, k, limit)) / (2 * d), k * stored, 2e-6);
  }
  EXPECT_DOUBLE_EQ(capped_energy(0.1, k, infinite), 0.5 * k * 0.01);
  EXPECT_DOUBLE_EQ(capped_energy(0.1, k, 0), 0);
}

TEST(CundallStrack, friction_acts_on_compression_plus_adhesion) {
  const CundallStrack law{34.0, 2e-10, 0.5};
  EXPECT_DOUBLE_EQ(law.tension(law.pull_off_gap()), 2e-10);
  EXPECT_DOUBLE_EQ(law.sliding_limit(0), 1e-10);
  EXPECT_DOUBLE_EQ(law.sliding_limit(-2e-10), 2e-10);
  EXPECT_DOUBLE_EQ(law.sliding_limit(3e-10), 0);
}

}  // namespace
