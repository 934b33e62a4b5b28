#include "common/numerics/noise.hpp"

#include <gtest/gtest.h>

#include <vector>
#include "tests/seeds.hpp"

using namespace crumble;

namespace {

TEST(Noise, is_a_function_of_its_key_and_every_part_of_the_key_matters) {
  const auto w = random_words(1, Purpose::start_position, 2, 3);
  EXPECT_EQ(w, random_words(1, Purpose::start_position, 2, 3));
  EXPECT_NE(w, random_words(2, Purpose::start_position, 2, 3));
  EXPECT_NE(w, random_words(1ULL << 32, Purpose::start_position, 2, 3));
  EXPECT_NE(w, random_words(1, Purpose::brownian_path, 2, 3));
  EXPECT_NE(w, random_words(1, Purpose::start_position, 3, 3));
  EXPECT_NE(w, random_words(1, Purpose::start_position, 2, 3 + (1ULL << 32)));
}

TEST(Noise, words_of_many_particles_are_those_of_each) {
  const std::vector<std::uint32_t> particle = {0, 1, 5, 6, 7, 8, 9, 1000, 4294967295u, 12, 13, 14, 15, 16, 17, 18, 3};
  const std::uint64_t seed = (7ULL << 32) + 11, index = (5ULL << 58) + 123456789;
  std::vector<std::uint32_t> rows(4 * particle.size());
  std::array<std::uint32_t*, 4> row;
  for (std::size_t k = 0; k < 4; ++k) row[k] = &rows[k * particle.size()];
  random_words(seed, Purpose::brownian_path, particle, index, row);
  for (std::size_t p = 0; p < particle.size(); ++p) {
    const auto words = random_words(seed, Purpose::brownian_path, particle[p], index);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(row[k][p], words[k]) << "particle " << particle[p];
  }
}

TEST(Noise, normal_numbers_have_unit_variance_and_no_mean_or_correlation) {
  const int count = 250000;  // four numbers each
  double sum = 0, squares = 0, fourth = 0, product = 0;
  for (int p = 0; p < count; ++p) {
    const auto g = random_normals(seeded(11), Purpose::brownian_path, p, 5);
    for (const double x : g) sum += x, squares += x * x, fourth += x * x * x * x;
    product += g[0] * g[1] + g[2] * g[3];
  }
  // Five standard errors: 6e-7 by chance for each of the four.
  const double n = 4.0 * count;
  expect_near("mean", sum / n, 0, 5 / std::sqrt(n));
  expect_near("variance", squares / n, 1, 5 * std::sqrt(2 / n));
  expect_near("kurtosis", fourth / n, 3, 5 * std::sqrt(96 / n));
  expect_near("correlation", product / (2 * count), 0, 5 / std::sqrt(2.0 * count));
}

TEST(Noise, uniform_numbers_stay_inside_the_open_interval) {
  EXPECT_GT(uniform(0), 0);
  EXPECT_LT(uniform(0xffffffffu), 1);
  EXPECT_DOUBLE_EQ(uniform(0) + uniform(0xffffffffu), 1);
}

}  // namespace
