#include "common/agglomerate/morphology.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "tests/agglomerate/shapes.hpp"

namespace crumble {
namespace {

constexpr double a = 10e-9;
// Sums of 1e3 terms round to some 1e-14 of the result.
constexpr double round_off = 1e-12;

struct Cluster {
  std::vector<Vector3> x;
  Particles p;
};
Cluster cluster(std::vector<Vector3> x) {
  const std::size_t count = x.size();
  return {std::move(x), shapes::equal_spheres(count, a)};
}
RadialExtent extent(const Cluster& c) { return radial_extent(c.x, c.p.radius, c.p.mass); }

TEST(Morphology, TenPerCentIsRoundedToTheNearestHalvesUpAndAtLeastOne) {
  EXPECT_EQ(tenth(1), 1u);
  EXPECT_EQ(tenth(14), 1u);
  EXPECT_EQ(tenth(15), 2u);
  EXPECT_EQ(tenth(85), 9u);
  EXPECT_EQ(tenth(102), 10u);
  EXPECT_EQ(tenth(115), 12u);
}

TEST(Morphology, ShellHasTheCrustOfOneDiameter) {
  const auto c = cluster(shapes::shell(2000, 70e-9));
  // The lattice's centre of mass is 1/N off the origin at most: radii agree to 1e-3.
  EXPECT_NEAR(extent(c).diameter(), 160e-9, 160e-9 * 1e-3);
  EXPECT_NEAR(extent(c).crust_thickness(), 20e-9, 160e-9 * 1e-3);
  EXPECT_NEAR(extent(c).relative_crust(), 0.125, 1e-3);
  EXPECT_NEAR(radius_of_gyration(c.x, c.p.mass), 70e-9, 70e-9 * 1e-3);
}

TEST(Morphology, SolidBallIsAsThickAsItsRadius) {
  const double ball = 300e-9;
  const auto c = cluster(shapes::lattice_ellipsoid(Vector3::Constant(ball), 20e-9));
  ASSERT_GT(c.x.size(), 10000u);
  // Continuum: the outer tenth lies between 0.9^(1/3) R and R, mean (3/4)(1 - 0.9^(4/3))/0.1 R = 0.98298 R; the nearest
  // tenth has mean (3/4) 0.1^(1/3) R = 0.34812 R. The lattice of spacing R/15 follows to 0.5 %.
  EXPECT_NEAR(extent(c).outer, 0.98298 * ball + a, 0.005 * ball);
  EXPECT_NEAR(extent(c).inner, 0.34812 * ball - a, 0.005 * ball);
  EXPECT_NEAR(radius_of_gyration(c.x, c.p.mass), std::sqrt(0.6) * ball, 0.005 * ball);
}

TEST(Morphology, InnerRadiusIsNeverNegativeSoThatHalfIsTheLargestRelativeCrust) {
  const auto two = cluster(shapes::chain(2, 0.5 * a));  // r - a = -0.75 a
  EXPECT_EQ(extent(two).inner, 0);
  EXPECT_EQ(extent(two).relative_crust(), 0.5);
}

TEST(Morphology, TwoSpheresTouching) {
  const auto c = cluster(shapes::chain(2, 2 * a));
  EXPECT_NEAR(extent(c).diameter(), 4 * a, round_off * a);
  EXPECT_NEAR(extent(c).inner, 0, round_off * a);
  EXPECT_NEAR(radius_of_gyration(c.x, c.p.mass), a, round_off * a);
  const auto axes = semi_axes(c.x, c.p.radius, c.p.mass);
  EXPECT_NEAR(axes[0], std::sqrt(6.0) * a, round_off * a);  // 5 (a^2 + a^2/5)
  EXPECT_NEAR(axes[1], a, round_off * a);
  EXPECT_NEAR(axes[2], a, round_off * a);
  // Two whole spheres inside one of twice their radius.
  EXPECT_NEAR(porosity(c.x, c.p.radius, c.p.mass, 2 * a), 0.75, round_off);
}

TEST(Morphology, OneSphereIsItsOwnEllipsoidAndHasNoPores) {
  const auto c = cluster({Vector3(5e-9, -3e-9, 1e-6)});
  EXPECT_NEAR(extent(c).diameter(), 2 * a, round_off * a);
  EXPECT_EQ(extent(c).relative_crust(), 0.5);
  for (double axis : semi_axes(c.x, c.p.radius, c.p.mass)) EXPECT_NEAR(axis, a, round_off * a);
  EXPECT_NEAR(porosity(c.x, c.p.radius, c.p.mass, extent(c).outer), 0, round_off);
  EXPECT_EQ(radius_of_gyration(c.x, c.p.mass), 0);
}

TEST(Morphology, ChainHasTheSemiAxesOfItsSecondMoment) {
  const std::size_t count = 21;
  const auto c = cluster(shapes::chain(count, 2 * a));
  const double n = static_cast<double>(count);
  const double moment = (n * n - 1) / 3 * a * a;  // mean of (2 a k)^2 over k = -10..10
  const auto axes = semi_axes(c.x, c.p.radius, c.p.mass);
  EXPECT_NEAR(axes[0], std::sqrt(5 * moment + a * a), round_off * n * a);
  EXPECT_NEAR(axes[1], a, round_off * n * a);
  EXPECT_NEAR(radius_of_gyration(c.x, c.p.mass), std::sqrt(moment), round_off * n * a);
}

TEST(Morphology, LatticeFillingAnEllipsoidReturnsItsSemiAxesDescending) {
  const Vector3 given(250e-9, 400e-9, 150e-9);
  const auto c = cluster(shapes::lattice_ellipsoid(given, 20e-9));
  const auto axes = semi_axes(c.x, c.p.radius, c.p.mass);
  // A lattice of spacing d has the surface uncertain by a fraction of d = 20 nm; 2 % of the axes.
  EXPECT_NEAR(axes[0], 400e-9, 8e-9);
  EXPECT_NEAR(axes[1], 250e-9, 5e-9);
  EXPECT_NEAR(axes[2], 150e-9, 4e-9);
}

TEST(Morphology, HeavierParticlesPullTheCentre) {
  const std::vector<Vector3> x{{0, 0, 0}, {3e-8, 0, 0}};
  const std::vector<double> radius{a, 2 * a}, mass{1, 8};
  EXPECT_NEAR(centre_of_mass(x, mass).x(), 8.0 / 9 * 3e-8, 1e-20);
  const auto r = radial_positions(x, mass);
  EXPECT_NEAR(r[0], 3e-8 / 9, 1e-20);
  EXPECT_NEAR(r[1], 3e-8 * 8 / 9, 1e-20);
  // Reach 36.7 nm (small sphere) against 23.3 nm; nearest surface -16.7 nm (large sphere), floored.
  EXPECT_NEAR(radial_extent(x, radius, mass).outer, 3e-8 * 8 / 9 + a, 1e-20);
  EXPECT_EQ(radial_extent(x, radius, mass).inner, 0);
}

TEST(Morphology, IntersectionOfSpheresMatchesTheLimitsAndTheIntegral) {
  EXPECT_EQ(intersection_volume(1, 1, 2), 0);
  EXPECT_NEAR(intersection_volume(3, 1, 1.5), 4 * std::numbers::pi / 3, round_off);
  EXPECT_NEAR(intersection_volume(3, 1, 2), 4 * std::numbers::pi / 3, round_off);
  EXPECT_NEAR(intersection_volume(1, 1, 1), 5 * std::numbers::pi / 12, round_off);  // textbook lens
  const double R = 2, b = 1, d = 1.7;
  double sum = 0;
  const int slices = 200000;
  for (int k = 0; k < slices; ++k) {
    const double z = d - b + 2 * b * (k + 0.5) / slices;
    sum += std::numbers::pi * std::max(0.0, std::min(R * R - z * z, b * b - (z - d) * (z - d))) * 2 * b / slices;
  }
  EXPECT_NEAR(intersection_volume(R, b, d), sum, 1e-8);  // midpoint rule with 2e5 slices
}

TEST(Morphology, DoesNotDependOnPlaceOrientationOrOrder) {
  auto x = shapes::random_points(115, 150e-9, 4);
  const Particles p = shapes::equal_spheres(x.size(), a);
  const Morphology before = morphology(p, shapes::frame(x));
  const Quaternion turn = Quaternion(0.3, -0.5, 0.7, 0.2).normalized();
  for (Vector3& v : x) v = turn * v + Vector3(1e-6, -2e-6, 5e-7);
  std::shuffle(x.begin(), x.end(), std::mt19937(5));
  const Morphology after = morphology(p, shapes::frame(x));
  // Coordinates of 2e-6 m carry 4e-22 m of round-off, 1e-14 of a radius; the squares 1e-12 of the moments.
  EXPECT_NEAR(after.extent.outer, before.extent.outer, 1e-11 * a);
  EXPECT_NEAR(after.extent.inner, before.extent.inner, 1e-11 * a);
  EXPECT_NEAR(after.radius_of_gyration, before.radius_of_gyration, 1e-11 * a);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(after.semi_axes[k], before.semi_axes[k], 1e-11 * a);
  EXPECT_NEAR(after.porosity, before.porosity, 1e-11);
  EXPECT_EQ(after.touching, before.touching);
}

TEST(Morphology, CountsBondedAndTouchingPairsApart) {
  const auto c = cluster({{0, 0, 0}, {2 * a, 0, 0}, {4.019 * a, 0, 0}, {6.05 * a, 0, 0}});
  const Frame frame = shapes::frame(c.x, {{.i = 0, .j = 1}});
  const Morphology m = morphology(c.p, frame);
  EXPECT_EQ(m.contacts, 1);
  EXPECT_EQ(m.touching, 2);  // gaps 0, 0.019 a, 0.031 a
  EXPECT_DOUBLE_EQ(m.coordination, 0.5);
  EXPECT_DOUBLE_EQ(m.coordination_touching, 1);
  EXPECT_EQ(m.fragments, 3);
  EXPECT_EQ(m.largest_fragment, 2);
  EXPECT_EQ(coordination(4, frame.contacts), (std::vector<std::int32_t>{1, 1, 0, 0}));
}

TEST(Morphology, EmptyAndMismatchedInputAreRefused) {
  EXPECT_THROW(morphology(Particles{}, Frame{}), std::invalid_argument);
  const auto c = cluster(shapes::chain(3, 2 * a));
  EXPECT_THROW(radius_of_gyration(c.x, std::vector<double>(2, 1.0)), std::invalid_argument);
}

TEST(Morphology, AHundredThousandParticlesAreAnalysed) {
  const auto x = shapes::lattice_ellipsoid(Vector3::Constant(580e-9), 20e-9);
  ASSERT_GT(x.size(), 100000u);
  const Morphology m = morphology(shapes::equal_spheres(x.size(), a), shapes::frame(x));
  EXPECT_GT(m.coordination_touching, 5.7);  // cubic lattice: 6 less the surface
  EXPECT_LT(m.coordination_touching, 6);
}

}  // namespace
}  // namespace crumble
