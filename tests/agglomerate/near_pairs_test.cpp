#include "common/agglomerate/near_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/contact/material.hpp"
#include "tests/agglomerate/shapes.hpp"

namespace crumble {
namespace {

std::vector<NearPair> by_all_pairs(const std::vector<Vector3>& x, const std::vector<double>& a, double fraction) {
  std::vector<NearPair> pairs;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(x.size()); ++i)
    for (std::int32_t j = i + 1; j < static_cast<std::int32_t>(x.size()); ++j) {
      const auto p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
      const double gap = (x[q] - x[p]).norm() - a[p] - a[q];
      if (gap < fraction * pair_radius(a[p], a[q])) pairs.push_back({i, j, gap});
    }
  return pairs;
}

void expect_same(const std::vector<NearPair>& found, const std::vector<NearPair>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].i, expected[k].i);
    EXPECT_EQ(found[k].j, expected[k].j);
    EXPECT_NEAR(found[k].gap, expected[k].gap, 1e-22);  // round-off of distances of 1e-7 m
  }
}

TEST(NearPairs, TreeSearchFindsWhatAllPairsFindForEqualRadii) {
  const auto x = shapes::random_points(600, 180e-9, 1);
  const std::vector<double> a(x.size(), 10e-9);
  const auto expected = by_all_pairs(x, a, 0.3);
  ASSERT_GT(expected.size(), 500u);
  expect_same(near_pairs(x, a, 0.3), expected);
}

TEST(NearPairs, TreeSearchFindsWhatAllPairsFindForRadiiDifferingByTen) {
  const auto x = shapes::random_points(600, 1e-6, 2);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> exponent(-8, -7);
  std::vector<double> a;
  for (std::size_t i = 0; i < x.size(); ++i) a.push_back(std::pow(10, exponent(engine)));
  const auto expected = by_all_pairs(x, a, 0.5);
  ASSERT_GT(expected.size(), 500u);
  expect_same(near_pairs(x, a, 0.5), expected);
}

TEST(NearPairs, ANegativeFractionKeepsOnlyDeepOverlaps) {
  const std::vector<Vector3> x{{0, 0, 0}, {19e-9, 0, 0}, {19e-9, 15e-9, 0}};
  const std::vector<double> a(3, 10e-9);
  const auto deep = near_pairs(x, a, -0.2);  // overlaps are 0.1 a and 0.5 a, the third pair is apart
  ASSERT_EQ(deep.size(), 1u);
  EXPECT_EQ(deep[0].i, 1);
  EXPECT_EQ(deep[0].j, 2);
}

TEST(NearPairs, CoincidentCentresAreAPair) {
  const std::vector<Vector3> x(50, Vector3(1e-9, 2e-9, 3e-9));
  const std::vector<double> a(50, 10e-9);
  EXPECT_EQ(near_pairs(x, a, 0).size(), 50u * 49u / 2u);
}

TEST(NearPairs, NoneForZeroOrOneParticle) {
  EXPECT_TRUE(near_pairs({}, {}, 1).empty());
  const std::vector<Vector3> x(1, Vector3::Zero());
  const std::vector<double> a(1, 1e-8);
  EXPECT_TRUE(near_pairs(x, a, 1).empty());
}

TEST(NearPairs, AMissingRadiusIsRefused) {
  const std::vector<Vector3> x(2, Vector3::Zero());
  const std::vector<double> a(1, 1e-8);
  EXPECT_THROW(near_pairs(x, a, 1), std::invalid_argument);
}

}  // namespace
}  // namespace crumble
