// The radii of the primary particles: equal, or drawn from a distribution.
#pragma once

#include <cstdint>
#include <vector>

namespace crumble::dryer {

struct RadiusDistribution {
  enum class Kind { equal, lognormal, bimodal };
  Kind kind = Kind::equal;
  double radius = 0;                        // a; of the lognormal its median, m
  double geometric_standard_deviation = 1;  // lognormal: exp(standard deviation of ln a)
  double second_radius = 0;                 // bimodal, m
  double second_share = 0;                  // bimodal: of the particles, by number
};

// Radii in descending order, the order in which a start is filled.
//   lognormal  ln a = ln(median) + ln(sigma_g) xi, xi standard normal within +-3 (drawn anew beyond: 0.3 % of the
//              draws), keyed by (seed, particle, attempt)
//   bimodal    round(share N) of the second kind, no chance in it
// By number, or by the sum of a^3 (m^3): as many particles as bring the sum nearest to it.
std::vector<double> radii_by_number(const RadiusDistribution& distribution, std::size_t number, std::uint64_t seed);
std::vector<double> radii_by_volume(const RadiusDistribution& distribution, double sum_of_cubes, std::uint64_t seed);

}  // namespace crumble::dryer
