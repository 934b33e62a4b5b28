#include "dryer/start.hpp"

#include <gtest/gtest.h>

#include "tests/dryer/samples.hpp"
#include "tests/seeds.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

TEST(Start, particles_are_immersed_and_do_not_overlap) {
  const Agglomerate s = samples::start(115, 215e-9, 1);
  for (std::size_t i = 0; i < 115; ++i) {
    EXPECT_LE(s.state.position[i].norm(), 205e-9);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((s.state.position[i] - s.state.position[j]).norm(), 20e-9);
  }
}

TEST(Start, is_uniform_in_the_volume_that_centres_can_take) {
  // (r/(R0 - a))^3 of dilute points is uniform in (0, 1): mean 1/2 within five standard errors of 2000 numbers, 6e-7 by
  // chance.
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (const Vector3& x : samples::start(20, 2150e-9, seeded(seed)).state.position)
      sum += std::pow(x.norm() / 2140e-9, 3);
  expect_near("mean of cubes", sum / 2000, 0.5, 5 * std::sqrt(1.0 / 12 / 2000));
}

TEST(Start, depends_on_the_seed_and_keeps_its_first_particles_when_more_are_added) {
  const auto ten = samples::start(10, 215e-9, 3).state.position, more = samples::start(100, 215e-9, 3).state.position;
  EXPECT_TRUE(std::equal(ten.begin(), ten.end(), more.begin()));
  EXPECT_NE(samples::start(10, 215e-9, 4).state.position, ten);
}

TEST(Start, that_cannot_be_packed_names_the_particle) {
  try {
    samples::start(100, 25e-9, 1);
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(" of 100"), std::string::npos) << error.what();
  }
}

}  // namespace
