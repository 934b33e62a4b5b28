#include "common/numerics/neighbours.hpp"

#include <gtest/gtest.h>

#include "common/numerics/noise.hpp"

using namespace crumble;

namespace {

std::vector<Eigen::Vector3d> cloud(int count, double width, std::uint64_t seed) {
  std::vector<Eigen::Vector3d> x;
  for (int p = 0; p < count; ++p) {
    const auto w = random_words(seed, Purpose::start_position, p, 0);
    x.emplace_back(width * (uniform(w[0]) - 0.5), width * (uniform(w[1]) - 0.5), width * (uniform(w[2]) - 0.5));
  }
  return x;
}

TEST(NeighbourSearch, finds_the_pairs_of_the_search_over_all_pairs) {
  NeighbourSearch search;
  for (const auto& [count, width] : {std::pair{2, 3.0}, {50, 8.0}, {400, 20.0}, {400, 5.0}, {300, 1000.0}}) {
    const auto x = cloud(count, width, count);
    std::vector<double> radius(count, 1.0);
    std::vector<Pair> found;
    search.find(x, radius, 0.3, found);
    EXPECT_EQ(found, neighbours_by_brute_force(x, radius, 0.3));
    for (int p = 0; p < count; ++p) radius[p] = 0.1 + 0.9 * uniform(random_words(7, Purpose::radius, p, 0)[0]);
    search.find(x, radius, 0.3, found);
    EXPECT_EQ(found, neighbours_by_brute_force(x, radius, 0.3));
  }
}

TEST(NeighbourSearch, sees_pairs_across_the_origin_and_coincident_centres) {
  const std::vector<Eigen::Vector3d> x{{-1e-9, 0, 0}, {1e-9, 0, 0}, {0, 0, 0}, {0, 0, 0}, {5, 0, 0}};
  const std::vector<double> radius(5, 1.0);
  std::vector<Pair> found;
  NeighbourSearch{}.find(x, radius, 0.1, found);
  EXPECT_EQ(found.size(), 6u);
}

TEST(NeighbourSearch, names_a_particle_whose_position_is_not_finite) {
  std::vector<Eigen::Vector3d> x = cloud(5, 4, 1);
  x[3].y() = std::nan("");
  const std::vector<double> radius(5, 1.0);
  std::vector<Pair> found;
  try {
    NeighbourSearch{}.find(x, radius, 0.1, found);
    FAIL() << "no error";
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("particle 3"), std::string::npos);
  }
}

TEST(NeighbourSearch, of_nothing_or_one_particle_is_empty) {
  std::vector<Pair> found{{1, 2}};
  NeighbourSearch{}.find({}, {}, 0.1, found);
  EXPECT_TRUE(found.empty());
  const std::vector<Eigen::Vector3d> x{{0, 0, 0}};
  const std::vector<double> radius{1.0};
  NeighbourSearch{}.find(x, radius, 0.1, found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
