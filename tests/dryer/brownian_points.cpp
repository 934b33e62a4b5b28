#include "tests/dryer/brownian_points.hpp"

#include <cmath>

#include "common/agglomerate/agglomerate.hpp"
#include "common/numerics/noise.hpp"

namespace crumble::dryer {

namespace {

// Uniform in the unit ball: the direction of three normal numbers, and a radius that is uniform in volume.
Vector3 start(std::uint64_t seed, std::uint32_t point) {
  const auto normal = random_normals(seed, Purpose::orientation, point, 0);
  const double volume = uniform(random_words(seed, Purpose::start_position, point, 0)[0]);
  return std::cbrt(volume) * Vector3(normal[0], normal[1], normal[2]).normalized();
}

}  // namespace

std::vector<double> PointParticles::radii(double theta) const {
  const double dt = theta / steps, spread = std::sqrt(2 / peclet * dt), last = std::sqrt(1 - theta);
  std::vector<double> radii;
  for (int point = 0; point < number; ++point) {
    const auto key = static_cast<std::uint32_t>(point);
    Vector3 x = start(seed, key);
    for (int step = 1; step <= steps; ++step) {
      const auto normal = random_normals(seed, Purpose::brownian_path, key, static_cast<std::uint64_t>(step));
      x += spread * Vector3(normal[0], normal[1], normal[2]);
      const double R = std::sqrt(1 - step * dt), r = x.norm();
      if (r > R) x *= (2 * R - r) / r;
    }
    radii.push_back(x.norm() / last);
  }
  return radii;
}

}  // namespace crumble::dryer
