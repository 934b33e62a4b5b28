#include "dryer/six_vector.hpp"

#include <gtest/gtest.h>

using namespace crumble;
using namespace crumble::dryer;

TEST(SixVector, a_register_of_vectors_comes_from_memory_and_goes_back_to_the_places_that_are_told) {
  alignas(64) SixVector in[lanes], out[lanes];
  for (std::size_t l = 0; l < lanes; ++l)
    for (std::size_t k = 0; k < 8; ++k) in[l].at[k] = k % 4 == 3 ? 0.0f : static_cast<float>(10 * l + k);
  const LaneVector translation = from_quarters([&](std::size_t l) { return Quad::load(in[l].at); }),
                   rotation = from_quarters([&](std::size_t l) { return Quad::load(in[l].at + 4); });
  to_six_vectors(to_quarters(translation), to_quarters(rotation), out);
  for (std::size_t l = 0; l < lanes; ++l) {
    EXPECT_EQ(translation.x[l], in[l].at[0]);
    EXPECT_EQ(translation.y[l], in[l].at[1]);
    EXPECT_EQ(translation.z[l], in[l].at[2]);
    EXPECT_EQ(rotation.z[l], in[l].at[6]);
    EXPECT_EQ(lane_at_place[place_of_lane(l)], l);
    for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(out[place_of_lane(l)].at[k], in[l].at[k]) << l << " " << k;
  }
}
