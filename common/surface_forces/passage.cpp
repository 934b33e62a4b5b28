#include "common/surface_forces/passage.hpp"

#include <cmath>
#include <numbers>

namespace crumble {

double mean_first_passage(const GapFunction& energy, double wall, double from, double to, double diffusivity) {
  constexpr int points = 20000;
  const double before_step = (from - wall) / points, step = (to - from) / points;
  const double zero = energy(from);  // of the energy, so that exponentials stay in range
  double inner = 0;
  for (int k = 0; k < points; ++k)
    inner += 0.5 * before_step *
             (std::exp(zero - energy(wall + k * before_step)) + std::exp(zero - energy(wall + (k + 1) * before_step)));
  double passage = 0, last = inner, weight = 1;
  for (int k = 1; k <= points; ++k) {
    const double U = energy(from + k * step) - zero, next_weight = std::exp(-U);
    inner += 0.5 * step * (weight + next_weight);
    passage += 0.5 * step * (last / weight + inner / next_weight);
    last = inner;
    weight = next_weight;
  }
  return passage / diffusivity;
}

double kramers_time(double height, double curvature_at_bottom, double curvature_on_top, double diffusivity) {
  return 2 * std::numbers::pi * std::exp(height) /
         (diffusivity * std::sqrt(curvature_at_bottom * std::abs(curvature_on_top)));
}

}  // namespace crumble
