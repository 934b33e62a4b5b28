// Bond forces of small rigid clusters in planar elongation against converged multipole values.
#include <gtest/gtest.h>

#include "common/contact/jkr.hpp"
#include "samples.hpp"

namespace crumble {
namespace {

using testing::network;
using testing::response;

const Eigen::Matrix3d elongation = planar_elongation(1).gradient;

// In 6 pi mu gamma_dot a^2.
double worst(const testing::Cluster& cluster, const HydroModel& model) {
  const Network net = network(cluster);
  const Response r = response(net, model);
  const double unit = 6 * std::numbers::pi * testing::radius * testing::radius;
  return worst_contact(r.tension, std::vector<double>(net.joints().size(), 1), elongation).tension / unit;
}

// References: multipoles converged with the order, error 1e-4 to 1e-3. What the order left out adds its own: the last
// two orders of each differ by less than the tolerance.
TEST(Clusters, LargestTensionsAreThoseOfConvergedMultipoles) {
  EXPECT_NEAR(worst(testing::chain(2), {Rung::multipole, 9}), 1.01936, 2e-4);
  EXPECT_NEAR(worst(testing::chain(3), {Rung::multipole, 7}), 1.4549, 1e-3);
  EXPECT_NEAR(worst(testing::triangle(), {Rung::multipole, 7}), 1.253, 2e-3);
  EXPECT_NEAR(worst(testing::tetrahedron(), {Rung::multipole, 6}), 1.475, 2e-3);
  EXPECT_NEAR(worst(testing::octahedron(), {Rung::multipole, 6}), 1.132, 2e-3);
}

TEST(Clusters, FarFieldDoubletAndItsCriticalStress) {
  const double n = worst(testing::chain(2), {});
  EXPECT_NEAR(n, 0.95238, 1e-5);  // digits of the reference; 20/21
  const double stress =
      pull_off_force(Material{}, testing::radius) / (6 * std::numbers::pi * testing::radius * testing::radius * n);
  EXPECT_NEAR(stress, 12600, 1);  // Pa
}

TEST(Clusters, RelativeLubricationMakesTheDoubletExact) {
  EXPECT_NEAR(worst(testing::chain(2), {Rung::fts_relative_lubrication}), 1.01936, 1e-5);
}

TEST(Clusters, WorstOrientationIsReachedAndNeverExceeded) {
  const Network net = network(testing::raft(3));
  const Response r = response(net, {});
  for (Eigen::Index b = 0; b < r.tension.rows(); ++b) {
    const Vector5 a = r.tension.row(b).transpose();
    const double largest = worst_tension(a, elongation);
    const auto tension = [&](const Eigen::Matrix3d& R) {
      return a.dot(strain_components(R.transpose() * elongation * R));
    };
    EXPECT_NEAR(tension(worst_orientation(a, elongation)), largest, 1e-14 * a.norm());
    // Simple shear has the same strain but for a turn of 45 degrees.
    EXPECT_NEAR(worst_tension(a, simple_shear(1).gradient), largest, 1e-14 * a.norm());
    for (std::uint32_t k = 0; k < 200; ++k) {
      const auto q = random_normals(3, Purpose::radius, k, 0);
      const Eigen::Matrix3d R = Quaternion(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
      EXPECT_LE(tension(R), largest + 1e-14 * a.norm());
    }
  }
}

// A gap of 1e-8 radii is no different from contact: the largest tension moves by about as much, lubrication or not.
TEST(Clusters, GapOf1em8IsContact) {
  for (const HydroModel& model : {HydroModel{Rung::multipole, 4}, HydroModel{Rung::fts_relative_lubrication}}) {
    testing::Cluster apart = testing::octahedron();
    const double touching = worst(apart, model);
    for (Vector3& x : apart.position) x *= 1 + 0.5e-8;
    EXPECT_NEAR(worst(apart, model), touching, 1e-6);
    for (Vector3& x : apart.position) x *= 1 - 1e-8;  // and so is an overlap
    EXPECT_NEAR(worst(apart, model), touching, 1e-6);
  }
}

TEST(Clusters, LoadsOfAFreeBodyBalance) {
  const Network net = network(testing::raft(3));
  const Response r = response(net, {Rung::multipole, 2});
  EXPECT_LT(r.imbalance, 1e-14);
  EXPECT_LT(r.residual, 1e-13);
}

}  // namespace
}  // namespace crumble
