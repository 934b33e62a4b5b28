#include "dryer/expected_cost.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/contact/bond_law.hpp"
#include "dryer/drag.hpp"
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

// Share of the lifetime until the solids take up this share of the droplet.
double drying_until(const DryingScene& s, double packing) {
  double solids = 0;
  for (const double a : s.radius) solids += std::pow(a / s.model.droplet.initial_radius, 3);
  return std::clamp(1 - std::pow(solids / packing, 2.0 / 3), 0.0, 1.0);
}

// Share of the droplet that the solids take up when there are so many bonds a particle: 0.115 at 0.3, 0.26 at one; 1
// when the first is left dry, measured.
double packing_with(double bonds) { return std::min(0.115 + (bonds - 0.3) * (0.26 - 0.115) / (1 - 0.3), 1.0); }

// With one bond a particle nearly all take short steps from then on.
ExpectedCost brownian_cost(const DryingScene& s) {
  const double a = s.smallest_radius(), N = static_cast<double>(s.radius.size());
  const auto stages = softening_stages(s);
  ExpectedCost cost;
  double begin = 0;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const bool last = k + 1 == stages.size();
    const double end = last ? 1 : drying_until(s, packing_with(stages[k].most_bonds));
    const double step = Brownian::short_step(softened_model(s, stages[k].softening), a, s.brownian.contact_step);
    const double short_steps = std::max(end - begin, 0.0) * s.model.droplet.lifetime / step;
    cost.steps += std::ldexp(short_steps, -stages[k].depth);
    const double packed = std::clamp((end - drying_until(s, packing_with(1))) / std::max(end - begin, 1e-9), 0.0, 1.0);
    cost.seconds += (5e-9 + 4.3e-8 * packed) * N * short_steps;
    begin = end;
  }
  return cost;
}

// Stages of the Chebyshev method, summed over steps that the front makes each in the time of the largest displacement;
// the fastest rate is some 12 k_s/zeta, or that at which a strong surface catches a particle. Three quarters of the
// particles are awake on average.
ExpectedCost stabilised_cost(const DryingScene& s) {
  const double a = s.smallest_radius(), zeta = drag_coefficient(s.model.viscosity, a);
  const Droplet& droplet = s.model.droplet;
  const BondLaw law(s.model.contact, s.model.material, a, a);
  const double bonds = 12 * std::max(law.normal_stiffness(), law.k_s) / zeta;
  const double rate = std::max(bonds, 4 * surface_rate(droplet, a, zeta, droplet.initial_radius));
  const double advance = droplet.initial_radius / a / s.stabilised.largest_displacement;
  const double steps = 2.0 / 3 * std::sqrt(2.5 * rate * droplet.lifetime * advance);
  return {steps, 0.75 * 24e-9 * static_cast<double>(s.radius.size()) * steps};
}

}  // namespace

ExpectedCost expected_cost(const DryingScene& s) {
  const double N = static_cast<double>(s.radius.size());
  if (s.is(IntegratorKind::inertial)) {
    const double steps = s.model.droplet.lifetime / s.step;
    return {steps, 0.05e-6 * N * steps};
  }
  if (s.is(IntegratorKind::brownian)) return brownian_cost(s);
  if (s.is(IntegratorKind::stabilised)) return stabilised_cost(s);
  const double advance = s.model.droplet.initial_radius / s.smallest_radius() / s.implicit.largest_displacement;
  const double steps = advance / 0.8 + 5.5 * std::pow(N, 0.75);
  return {steps, 3e-6 * std::pow(N, 0.23) * N * steps};
}

std::string expected_cost_text(const DryingScene& s) {
  const ExpectedCost cost = expected_cost(s);
  return fmt::format("expected: about {} steps, {} on one core{}", rounded(cost.steps), duration(cost.seconds),
                     !s.estimate_error                  ? ""
                     : s.is(IntegratorKind::stabilised) ? ", and about three quarters as much for the error estimate"
                                                        : ", and about half as much for the error estimate");
}

}  // namespace crumble
