#include "dryer/liquid_volume.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace crumble::dryer {

using std::numbers::pi;

double shared_volume(double R, double a, double d) {
  if (d >= R + a) return 0;
  const double smaller = std::min(R, a);
  if (d <= std::abs(R - a)) return 4.0 / 3 * pi * smaller * smaller * smaller;
  const double reach = R + a - d, difference = R - a;
  return pi * reach * reach * (d * d + 2 * d * (R + a) - 3 * difference * difference) / (12 * d);
}

double liquid_volume(const Particles& particles, const Frame& frame, double R) {
  double volume = 4.0 / 3 * pi * R * R * R;
  for (std::size_t p = 0; p < particles.size(); ++p)
    volume -= shared_volume(R, particles.radius[p], frame.position[p].norm());
  return std::max(volume, 0.0);
}

double liquid_volume(const Particles& particles, double R) {
  double cubes = R * R * R;
  for (const double a : particles.radius) cubes -= a * a * a;
  return 4.0 / 3 * pi * cubes;
}

}  // namespace crumble::dryer
