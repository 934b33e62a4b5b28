// The capillary force of many particles at once, in single precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dryer/six_vector.hpp"

namespace crumble::dryer {

// Force of capillary_force() (Eq. 8) over the distance from the centre of the droplet, N/m, for a particle of
// radius a at a distance whose square is larger than that of the front by `excess`: r - R as a difference of squares,
// for its digits. 0 where the surface does not cut the particle (surface_cuts()). At most 0; times the position it is
// the force, good to 1e-5 of the largest (test).
// Number: float, or a register of them.
template <class Number>
inline Number surface_pull(const Number& surface_tension, const Number& R, const Number& a, const Number& excess) {
  using std::max, std::sqrt;
  const Number none = 0, r = sqrt(max(excess + R * R, none)), offset = excess / (r + R);
  const Number squared = where_greater(r + R, a, max((a - offset) * (a + offset), none), none);
  return -2 * std::numbers::pi_v<float> * surface_tension * sqrt(squared) / max(r, 1e-6f * R);
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
  for (std::size_t m = 0; m < count; m += lanes)
    surface_pull<Lane>(sigma, front, Lane::load(radius + m), Lane::load(pull + m)).store(pull + m);
}

}  // namespace crumble::dryer
