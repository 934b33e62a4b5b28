#include "dryer/brownian_path.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cmath>
#include "tests/seeds.hpp"

#include "common/numerics/noise.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

std::vector<std::uint32_t> ids(std::uint32_t count) {
  std::vector<std::uint32_t> out(count);
  for (std::uint32_t p = 0; p < count; ++p) out[p] = p;
  return out;
}

}  // namespace

TEST(BrownianPath, fine_increments_fill_the_coarse_one) {
  const BrownianPath path(7);
  const auto particles = ids(13);
  std::vector<float> fine;
  std::vector<float> whole;
  for (const std::uint64_t interval : {0, 1, 2, 77}) {
    path.whole(particles, interval, whole);
    for (const int depth : {0, 1, 2, 5}) {
      path.fill(particles, interval, depth, 16, fine);
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t p = 0; p < 13; ++p) {
          double sum = 0;
          for (std::size_t m = 0; m < 1u << depth; ++m) sum += fine[(m * 6 + k) * 16 + p];
          // Unit variance each, in units of their own interval.
          EXPECT_NEAR(sum / std::sqrt(std::ldexp(1, depth)), whole[k * 13 + p], 1e-5);  // single precision
        }
    }
  }
}

TEST(BrownianPath, fills_of_any_depth_go_the_same_way) {
  const BrownianPath path(7);
  const auto particles = ids(5);
  std::vector<float> coarse, fine;
  path.fill(particles, 3, 3, 16, coarse);
  path.fill(particles, 3, 6, 16, fine);
  for (std::size_t k = 0; k < 6; ++k)
    for (std::size_t p = 0; p < 5; ++p) {
      double sum = 0, finer = 0;
      for (std::size_t m = 0; m < 8; ++m) sum += coarse[(m * 6 + k) * 16 + p];
      for (std::size_t m = 0; m < 64; ++m) finer += fine[(m * 6 + k) * 16 + p];
      EXPECT_NEAR(finer / 8, sum / std::sqrt(8.0), 1e-5);  // single precision
    }
}

TEST(BrownianPath, a_particle_has_its_path_whoever_is_asked_for_with_it) {
  const BrownianPath path(7);
  std::vector<float> together, alone;
  path.fill(ids(9), 4, 4, 16, together);
  const std::vector<std::uint32_t> one = {6};
  path.fill(one, 4, 4, 16, alone);
  for (std::size_t row = 0; row < 6 << 4; ++row) EXPECT_EQ(alone[row * 16], together[row * 16 + 6]);
}

// The sine is taken from a cosine in single precision, whose last digit is 3e-4 of it where it is smallest.
TEST(BrownianPath, increments_are_those_of_Box_and_Muller_from_its_words) {
  const auto particles = ids(999);
  std::vector<float> out;
  BrownianPath(7).whole(particles, 5, out);
  for (const std::uint32_t p : particles) {
    const auto reference = random_normals(7, Purpose::brownian_path, p, 5);
    EXPECT_NEAR(out[p], reference[0], 5e-6);
    EXPECT_NEAR(out[999 + p], reference[1], 3e-3);
    EXPECT_NEAR(out[2 * 999 + p], reference[2], 5e-6);
  }
}

TEST(BrownianPath, other_seeds_particles_and_intervals_are_other_numbers) {
  const auto first = [](std::uint64_t seed, std::uint32_t particle, std::uint64_t interval) {
    const std::vector<std::uint32_t> one = {particle};
    std::vector<float> out;
    BrownianPath(seed).whole(one, interval, out);
    return out[0];
  };
  EXPECT_NE(first(1, 0, 0), first(2, 0, 0));
  EXPECT_NE(first(1, 0, 0), first(1, 1, 0));
  EXPECT_NE(first(1, 0, 0), first(1, 0, 1));
  EXPECT_EQ(first(1, 0, 0), first(1, 0, 0));
}

// Mean 0, variance 1, kurtosis 3 and no correlation between any two of the twelve rows of neighbouring intervals, each
// within 5 standard errors: 6e-7 by chance, 4e-5 for all 69 numbers.
TEST(BrownianPath, increments_are_standard_normal_and_independent) {
  const BrownianPath path(seeded(1));
  const std::size_t count = 96;
  const int depth = 4, intervals = 40;
  const auto particles = ids(count);
  std::vector<float> out;
  double mean = 0, square = 0, fourth = 0;
  Eigen::Matrix<double, 12, 12> product = Eigen::Matrix<double, 12, 12>::Zero();
  std::size_t total = 0, pairs = 0;
  for (std::uint64_t interval = 0; interval < intervals; ++interval) {
    path.fill(particles, interval, depth, count, out);
    for (std::size_t m = 0; m < 16; m += 2)
      for (std::size_t p = 0; p < count; ++p) {
        Eigen::Matrix<double, 12, 1> x;
        for (std::size_t k = 0; k < 12; ++k) x[static_cast<Eigen::Index>(k)] = out[(m * 6 + k) * count + p];
        product += x * x.transpose();
        ++pairs;
        for (const double v : x) {
          mean += v;
          square += v * v;
          fourth += v * v * v * v;
          ++total;
        }
      }
  }
  const double n = static_cast<double>(total), root = std::sqrt(n);
  expect_near("mean", mean / n, 0, 5 / root);
  expect_near("variance", square / n, 1, 5 * std::sqrt(2.0) / root);
  expect_near("kurtosis", fourth / n, 3, 5 * std::sqrt(96.0) / root);
  product /= static_cast<double>(pairs);
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < i; ++j)
      expect_near("any correlation", product(i, j), 0, 5 / std::sqrt(static_cast<double>(pairs)));
}
