// The capillary force of many particles at once, in single precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dryer/six_vector.hpp"

namespace crumble {

// Force of capillary_force() (Eq. 8) over the distance from the centre of the droplet, N/m, for a particle of
// radius a at a distance whose square is larger than that of the front by `excess`: r - R as a difference of squares,
// for its digits. 0 where the surface does not cut the particle (surface_cuts()). At most 0; times the position it is
// the force, good to 1e-5 of the largest (test).
inline float surface_pull(float surface_tension, float R, float a, float excess) {
  const float r = std::sqrt(std::max(excess + R * R, 0.0f)), offset = excess / (r + R);
  const float squared = r + R > a ? std::max((a - offset) * (a + offset), 0.0f) : 0.0f;
  return -2 * std::numbers::pi_v<float> * surface_tension * std::sqrt(squared) / std::max(r, 1e-6f * R);
}

// pull, radius: padded() to whole registers. Leaves pull as it is where there is no liquid left (R = 0).
inline void surface_pulls(double surface_tension, double R, const Position* position, const float* radius,
                          std::size_t count, float* pull) {
  const auto sigma = static_cast<float>(surface_tension), front = static_cast<float>(R);
  if (front == 0) return;
  for (std::size_t m = 0; m < count; ++m) {
    const double* x = position[m].at;
    pull[m] = static_cast<float>(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - R * R);
  }
#pragma omp simd
  for (std::size_t m = 0; m < padded(count); ++m) pull[m] = surface_pull(sigma, front, radius[m], pull[m]);
}

}  // namespace crumble
