#include "common/surface_forces/stability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace crumble {

namespace {

constexpr int grid = 4000;

// The largest value of f among the inner points of a grid in ln h, refined by golden section.
std::optional<Extreme> maximum(const GapFunction& f, double from, double to) {
  const double ratio = std::log(to / from) / grid;
  const auto at = [&](int k) { return from * std::exp(k * ratio); };
  int best = 0;
  double largest = f(from);
  for (int k = 1; k <= grid; ++k)
    if (const double value = f(at(k)); value > largest) best = k, largest = value;
  if (best == 0 || best == grid) return std::nullopt;
  double low = at(best - 1), high = at(best + 1);
  constexpr double golden = 1 / std::numbers::phi;
  while (high - low > 1e-9 * high) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    if (f(left) > f(right))
      high = right;
    else
      low = left;
  }
  const double gap = 0.5 * (low + high);
  return Extreme{gap, f(gap)};
}

}  // namespace

std::optional<Extreme> barrier(const GapFunction& energy, double from, double to) {
  const auto found = maximum(energy, from, to);
  return found && found->value > 0 ? found : std::nullopt;
}

std::optional<Extreme> outer_minimum(const GapFunction& energy, double from, double to) {
  const auto found = maximum([&](double h) { return -energy(h); }, from, to);
  return found && found->value > 0 ? std::optional(Extreme{found->gap, -found->value}) : std::nullopt;
}

double squeezing_resistance(double gap, double a) {
  const double u = gap / a;
  return (6 * u * u + 13 * u + 2) / (6 * u * u + 4 * u);
}

double log_stability_ratio(const GapFunction& energy, const GapFunction& attraction, double a, Drainage drainage) {
  constexpr int points = 20000;
  const double from = std::log(1e-7 * a), width = (std::log(1e4 * a) - from) / points;
  const auto log_integral = [&](const GapFunction& U) {
    double largest = U(1e-7 * a), sum = 0;
    for (int k = 0; k <= points; ++k) largest = std::max(largest, U(std::exp(from + k * width)));
    for (int k = 0; k <= points; ++k) {
      const double h = std::exp(from + k * width), r = 2 * a + h;
      const double beta = drainage == Drainage::free ? 1 : squeezing_resistance(h, a);
      sum += (k % points == 0 ? 0.5 : 1) * beta * std::exp(U(h) - largest) * h / (r * r);
    }
    return largest + std::log(sum);
  };
  return log_integral(energy) - log_integral(attraction);
}

double rapid_coagulation_half_time(double viscosity, double a, double volume_fraction, double thermal_energy) {
  return std::numbers::pi * viscosity * a * a * a / (volume_fraction * thermal_energy);
}

}  // namespace crumble
