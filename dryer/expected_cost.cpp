#include "dryer/expected_cost.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "dryer/run.hpp"

namespace crumble {

namespace {

std::string duration(double seconds) {
  if (seconds < 90) return fmt::format("{:.2g} s", seconds);
  if (seconds < 5400) return fmt::format("{:.2g} min", seconds / 60);
  if (seconds < 2 * 86400) return fmt::format("{:.2g} h", seconds / 3600);
  return fmt::format("{:.2g} days", seconds / 86400);
}

std::string rounded(double steps) {
  return steps < 1e5 ? fmt::format("{:.0f}", std::round(steps / 10) * 10) : fmt::format("{:.1e}", steps);
}

}  // namespace

ExpectedCost expected_cost(const DryingScene& s) {
  const double N = static_cast<double>(s.radius.size());
  if (s.inertial) {
    const double steps = s.model.droplet.lifetime / s.step;
    return {steps, 0.05e-6 * N * steps};
  }
  if (s.model.thermal_energy > 0) {
    const double a = s.smallest_radius();
    const double step = Brownian::short_step(effective_model(s), a, s.brownian.contact_step);
    const double steps = s.model.droplet.lifetime / std::ldexp(step, s.brownian.depth);
    return {steps, 2e-6 * N * steps};
  }
  const double advance = s.model.droplet.initial_radius / s.smallest_radius() / s.control.largest_displacement;
  const double steps = advance / 0.8 + 5.5 * N;
  return {steps, 3e-6 * std::pow(N, 0.23) * N * steps};
}

std::string expected_cost_text(const DryingScene& s) {
  const ExpectedCost cost = expected_cost(s);
  return fmt::format("expected: about {} steps, {} on one core{}", rounded(cost.steps), duration(cost.seconds),
                     s.estimate_error ? ", and about half as much for the error estimate" : "");
}

}  // namespace crumble
