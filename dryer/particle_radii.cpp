#include "dryer/particle_radii.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/numerics/noise.hpp"

namespace crumble::dryer {

namespace {

using Kind = RadiusDistribution::Kind;

double cube(double a) { return a * a * a; }

double lognormal_radius(const RadiusDistribution& d, std::uint64_t seed, std::size_t particle) {
  for (std::uint64_t attempt = 0;; ++attempt)
    for (const double xi : random_normals(seed, Purpose::radius, static_cast<std::uint32_t>(particle), attempt))
      if (std::abs(xi) <= 3) return d.radius * std::pow(d.geometric_standard_deviation, xi);
}

std::vector<double> two_kinds(const RadiusDistribution& d, std::size_t number) {
  const double share = d.kind == Kind::bimodal ? d.second_share : 0;
  const auto second = static_cast<std::size_t>(std::lround(share * static_cast<double>(number)));
  std::vector<double> radius(number - second, d.radius);
  radius.resize(number, d.second_radius);
  return radius;
}

std::vector<double> descending(std::vector<double> radius) {
  std::sort(radius.begin(), radius.end(), std::greater<>());
  return radius;
}

}  // namespace

std::vector<double> radii_by_number(const RadiusDistribution& d, std::size_t number, std::uint64_t seed) {
  if (d.kind != Kind::lognormal) return descending(two_kinds(d, number));
  std::vector<double> radius(number);
  for (std::size_t p = 0; p < number; ++p) radius[p] = lognormal_radius(d, seed, p);
  return descending(std::move(radius));
}

std::vector<double> radii_by_volume(const RadiusDistribution& d, double sum_of_cubes, std::uint64_t seed) {
  if (d.kind != Kind::lognormal) {
    const double share = d.kind == Kind::bimodal ? d.second_share : 0;
    const double mean = (1 - share) * cube(d.radius) + share * cube(d.second_radius);
    return radii_by_number(d, static_cast<std::size_t>(std::round(sum_of_cubes / mean)), seed);
  }
  std::vector<double> radius;
  for (double left = sum_of_cubes;;) {
    const double next = lognormal_radius(d, seed, radius.size());
    if (cube(next) > 2 * left) return descending(std::move(radius));
    radius.push_back(next);
    left -= cube(next);
  }
}

}  // namespace crumble::dryer
