// For tests whose result depends on a seed. CRUMBLE_TEST_SEED=k (0: as if not set) gives all of them other seeds, and
// has each comparison printed for pipeline/verify/test_seeds.py, which runs 20 such sets and prints how much room
// bounds leave.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

namespace crumble {

inline std::uint64_t seed_set() {
  static const char* text = std::getenv("CRUMBLE_TEST_SEED");
  static const std::uint64_t set = text ? std::strtoull(text, nullptr, 10) : 0;
  return set;
}

// Sets do not overlap: no test counts its seeds up to 10,000.
inline std::uint64_t seeded(std::uint64_t seed) { return seed + 10000 * seed_set(); }

constexpr double unbounded = std::numeric_limits<double>::infinity();

// low <= value <= high, of a value that scatters with the seed; `what` tells the comparisons of one test apart.
template <class Number>
void expect_within(const std::string& what, Number number, double low, double high) {
  const auto value = static_cast<double>(number);
  EXPECT_GE(value, low) << what;
  EXPECT_LE(value, high) << what;
  if (seed_set() != 0) std::printf("[STATISTIC] %.9g in %.9g to %.9g: %s\n", value, low, high, what.c_str());
}

template <class Number>
void expect_near(const std::string& what, Number number, double expected, double room) {
  expect_within(what, number, expected - room, expected + room);
}

}  // namespace crumble
