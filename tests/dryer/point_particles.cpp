// Brownian points inside a reflecting surface against the continuum. Points are independent, so that the counts in
// shells are multinomial and the sampling error is known.
#include "tests/dryer/brownian_points.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dryer/continuum.hpp"
#include "tests/seeds.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

constexpr int shells = 10;

Continuum continuum(double peclet, double theta) {
  Continuum model(peclet, {1000, 1e-9});  // to 1e-5: nothing beside the sampling error
  model.advance_to(theta);
  return model;
}

// Sum over ten shells of equal volume of (count - expected)^2/expected.
double chi_square(const std::vector<double>& rho, const Continuum& model) {
  std::vector<double> count(shells, 0.0);
  for (const double r : rho) ++count[std::min(shells - 1, static_cast<int>(shells * r * r * r))];
  double sum = 0;
  for (int shell = 0; shell < shells; ++shell) {
    const double fraction = model.fraction_within(std::cbrt((shell + 1.0) / shells)) -
                            model.fraction_within(std::cbrt(static_cast<double>(shell) / shells));
    const double expected = fraction * static_cast<double>(rho.size());
    sum += (count[shell] - expected) * (count[shell] - expected) / expected;
  }
  return sum;
}

// Exceeded with probability 7e-6 by chi-square of 9 degrees of freedom: the false-alarm rate of each comparison.
constexpr double band = 40.2;

// The finite step adds less than 0.4 to chi-square (measured with 400,000 points), whose standard deviation is 4.2.
class PointParticlesAt : public ::testing::TestWithParam<double> {};

TEST_P(PointParticlesAt, lie_in_the_sampling_band_around_the_continuum) {
  const double peclet = GetParam();
  for (const double theta : {0.2, 0.4}) {
    const auto rho = PointParticles{peclet, 6000, 1000, seeded(7)}.radii(theta);
    expect_within(fmt::format("chi-square at theta {}", theta), chi_square(rho, continuum(peclet, theta)), 0, band);
  }
}

TEST_P(PointParticlesAt, have_the_mean_radius_of_the_continuum) {
  const double peclet = GetParam(), theta = 0.4;
  const auto rho = PointParticles{peclet, 6000, 1000, seeded(11)}.radii(theta);
  const Continuum model = continuum(peclet, theta);
  double expected = 1, mean = 0, square = 0;  // <rho> = 1 - integral of the fraction within rho
  for (int k = 0; k < 200; ++k) expected -= model.fraction_within((k + 0.5) / 200) / 200;
  for (const double r : rho) mean += r, square += r * r;
  const auto n = static_cast<double>(rho.size());
  mean /= n;
  const double standard_error = std::sqrt((square / n - mean * mean) / n);
  expect_near("mean radius", mean, expected, 5 * standard_error);  // 6e-7 by chance
}

INSTANTIATE_TEST_SUITE_P(Peclet, PointParticlesAt, ::testing::Values(1.0, 10.0),
                         [](const auto& given) { return given.param == 1 ? "1" : "10"; });

TEST(PointParticles, the_band_is_narrow_enough_to_tell_a_wrong_diffusivity) {
  const auto rho = PointParticles{10, 6000, 1000, seeded(7)}.radii(0.4);
  for (const double wrong : {5, 20})
    expect_within(fmt::format("chi-square at Pe {}", wrong), chi_square(rho, continuum(wrong, 0.4)), band, unbounded);
}

TEST(PointParticles, are_the_same_for_the_same_seed_and_other_points_for_another) {
  const auto radii = [](std::uint64_t seed) { return PointParticles{1, 20, 50, seed}.radii(0.2); };
  EXPECT_EQ(radii(3), radii(3));
  EXPECT_NE(radii(3), radii(4));
}

}  // namespace
