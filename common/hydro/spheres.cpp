#include "common/hydro/spheres.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace crumble {

namespace {

// Sorted along x, a sphere can only touch those within the reach of the two radii: near-linear for real clusters.
void check_overlap(const Spheres& s) {
  std::vector<int> order(s.position.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) { return s.position[i].x() < s.position[j].x(); });
  const double largest = *std::max_element(s.radius.begin(), s.radius.end());
  for (std::size_t p = 0; p < order.size(); ++p)
    for (std::size_t q = p + 1; q < order.size(); ++q) {
      const int i = order[p], j = order[q];
      const Vector3 d = s.position[j] - s.position[i];
      if (d.x() > s.radius[i] + largest) break;
      const double r = d.norm(), sum = s.radius[i] + s.radius[j];
      if (r < closest_approach * sum)
        throw std::invalid_argument(
            fmt::format("spheres {} and {} overlap too deeply: distance {:.6g}, sum of radii {:.6g} "
                        "(hydrodynamics needs at least {} of it)",
                        i, j, r, sum, closest_approach));
    }
}

}  // namespace

void check(const Spheres& s) {
  if (s.radius.empty()) throw std::invalid_argument("hydrodynamics of no sphere at all");
  if (s.position.size() != s.radius.size())
    throw std::invalid_argument(fmt::format("{} positions for {} radii", s.position.size(), s.radius.size()));
  for (int i = 0; i < s.size(); ++i) {
    if (!(s.radius[i] > 0) || !std::isfinite(s.radius[i]))
      throw std::invalid_argument(fmt::format("radius of sphere {} is {}", i, s.radius[i]));
    if (!s.position[i].allFinite()) throw std::invalid_argument(fmt::format("position of sphere {} is not finite", i));
  }
  check_overlap(s);
}

double mean_radius(const Spheres& s) {
  return std::accumulate(s.radius.begin(), s.radius.end(), 0.0) / static_cast<double>(s.radius.size());
}

Spheres scaled(const Spheres& s, double factor) {
  Spheres result = s;
  for (auto& x : result.position) x *= factor;
  for (auto& a : result.radius) a *= factor;
  return result;
}

}  // namespace crumble
