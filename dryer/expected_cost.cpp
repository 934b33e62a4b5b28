#include "dryer/expected_cost.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/contact/bond_law.hpp"
#include "common/io/progress.hpp"
#include "dryer/cost_sample.hpp"
#include "dryer/drag.hpp"
#include "dryer/pair_statistics.hpp"
#include "dryer/process_inputs.hpp"
#include "dryer/run.hpp"

namespace crumble::dryer {

namespace {

std::string rounded(double steps) {
  return steps < 1e5 ? fmt::format("{:.0f}", std::round(steps / 10) * 10) : fmt::format("{:.1e}", steps);
}

// Share of the droplet at the start that the solids are.
double solids_of(const DryingScene& s) {
  double solids = 0;
  for (const double a : s.radius) solids += std::pow(a / s.model.droplet.initial_radius, 3);
  return solids;
}

// Share of the lifetime until the solids take up this share of the droplet.
double drying_until(double solids, double packing) {
  return std::clamp(1 - std::pow(solids / packing, 2.0 / 3), 0.0, 1.0);
}

// Share of the droplet that the solids take up when there are so many bonds a particle: 0.115 at 0.3, 0.26 at one; 1
// when the first is left dry, measured.
double packing_with(double bonds) { return std::min(0.115 + (bonds - 0.3) * (0.26 - 0.115) / (1 - 0.3), 1.0); }

// Fills the profile with the integral of a rate of work over the front's way, the rate at a fraction 1 - R/R0; returns
// the integral.
template <class Rate>
double add_up(ExpectedCost& cost, Rate rate) {
  const auto last = static_cast<double>(cost.done.size() - 1);
  for (std::size_t k = 1; k < cost.done.size(); ++k)
    cost.done[k] = cost.done[k - 1] + rate((static_cast<double>(k) - 0.5) / last) / last;
  const double whole = cost.done.back();
  for (double& part : cost.done) part /= whole;
  return whole;
}

// Share of the particles that have a neighbour within reach or a bond, where the solids take up `packing`: one minus
// the chance of none (Poisson) in the shell in which the pair would be near, and in what a bond holds.
double share_near(double packing, double a, double margin, double stickiness) {
  const double shell = std::pow(1 + margin / (2 * a), 3) - 1 + 3 * std::min(stickiness, 100 * a) / (2 * a);
  return 1 - std::exp(-8 * packing * shell);
}

// Bonds that thermal motion does not break: half of the particles have met after t = 3 mu/(4 kT n) (Smoluchowski).
double share_clustered(const DryingScene& s, double time) {
  const double R = s.model.droplet.initial_radius;
  const double density = static_cast<double>(s.radius.size()) / (4.0 / 3 * std::numbers::pi * R * R * R);
  const double half = 3 * s.model.viscosity / (4 * s.model.thermal_energy * density);
  return time / (time + half);
}

void brownian_cost(const DryingScene& s, ExpectedCost& cost, double& seconds) {
  const double a = s.smallest_radius(), N = static_cast<double>(s.radius.size()), phi = solids_of(s);
  const double kT = s.model.thermal_energy, D = kT / drag_coefficient(s.model.viscosity, a);
  const double tau = s.model.droplet.lifetime, R0 = s.model.droplet.initial_radius, peclet = R0 * R0 / (D * tau);
  const double short_time = measured_seconds(s, SampleState::packed),
               long_time = measured_seconds(s, SampleState::loose);
  struct Stage {
    double end, step, margin, stickiness, lifetime;
    int depth;
  };
  std::vector<Stage> stages;
  double begin = 0;
  for (const SofteningStage& stage : softening_stages(s)) {
    const DryingModel model = softened_model(s, stage.softening);
    const double step = Brownian::short_step(model, a, s.brownian.contact_step);
    const double end = std::isinf(stage.most_bonds) && stage.depth > s.brownian.depth ? 1
                       : std::isinf(stage.most_bonds)                                 ? drying_until(phi, 1)
                                                      : drying_until(phi, packing_with(stage.most_bonds));
    const PairStatistics pair = pair_statistics(Jkr(model.material, a), kT, 2 * D);
    stages.push_back({std::max(begin, end), step, 6 * std::sqrt(4 * D * std::ldexp(step, stage.depth)), pair.stickiness,
                      pair.lifetime, stage.depth});
    cost.steps += std::max(end - begin, 0.0) * tau / std::ldexp(step, stage.depth);
    begin = std::max(begin, end);
  }
  if (stages.size() == 1) {
    cost.steps = tau / std::ldexp(stages[0].step, stages[0].depth);
    stages[0].end = 1;
  }
  seconds = N * add_up(cost, [&](double fraction) {
              const double R = 1 - fraction, t = 1 - R * R;
              const auto stage =
                  std::find_if(stages.begin(), stages.end() - 1, [&](const Stage& k) { return t <= k.end; });
              const double packing = std::min(phi / (R * R * R), 0.64);
              double share = share_near(packing, a, stage->margin, stage->stickiness);
              if (stage->lifetime > 0.1 * a * a / D) share = std::max(share, share_clustered(s, t * tau));
              const double swept = (1 - R * R * R) * peclet / (peclet + 20);
              share = swept + (1 - swept) * share;
              const double steps = 2 * R * tau / stage->step;  // short ones, for the front's way
              return steps * (share * short_time + (1 - share) * std::ldexp(long_time, -stage->depth));
            });
}

void stabilised_cost(const DryingScene& s, ExpectedCost& cost, double& seconds) {
  const double a = s.smallest_radius(), zeta = drag_coefficient(s.model.viscosity, a);
  const Droplet& droplet = s.model.droplet;
  const BondLaw law(s.model.contact, s.model.material, a, a);
  const double bonds = 12 * std::max(law.normal_stiffness(), law.k_s) / zeta;
  const double rate = std::max(bonds, 4 * surface_rate(droplet, a, zeta, droplet.initial_radius));
  const double advance = droplet.initial_radius / a / s.stabilised.largest_displacement;
  cost.steps = 2.0 / 3 * std::sqrt(2.5 * rate * droplet.lifetime * advance);
  // Evaluations for the front's way go like the root of R; those swept so far are awake, three quarters on average.
  const double phi = solids_of(s);
  const double swept = add_up(cost, [&](double fraction) {
    const double R = 1 - fraction;
    return 1.5 * std::sqrt(R) * std::min(1.0, 1 - R * R * R + 0.5 * phi / (R * R * R));
  });
  seconds = 0.75 / std::max(swept, 0.5) * swept * cost.steps * static_cast<double>(s.radius.size()) *
            measured_seconds(s, SampleState::packed);
}

void implicit_cost(const DryingScene& s, ExpectedCost& cost, double& seconds) {
  const double N = static_cast<double>(s.radius.size()), n = static_cast<double>(sample_size(s));
  const double advance = s.model.droplet.initial_radius / s.smallest_radius() / s.implicit.largest_displacement;
  cost.steps = advance / 0.8 + 5.5 * std::pow(N, 0.75);
  add_up(cost, [](double fraction) { return 1 - std::pow(1 - fraction, 3); });
  seconds = std::pow(N / n, 0.23) * N * cost.steps * measured_seconds(s, SampleState::packed);
}

void inertial_cost(const DryingScene& s, ExpectedCost& cost, double& seconds) {
  cost.steps = s.model.droplet.lifetime / s.step;
  add_up(cost, [](double fraction) { return 1 - fraction; });
  seconds = 0.5 * (measured_seconds(s, SampleState::packed) + measured_seconds(s, SampleState::loose)) *
            static_cast<double>(s.radius.size()) * cost.steps;
}

}  // namespace

double ExpectedCost::share(double fraction) const {
  const double place = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(done.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), done.size() - 2);
  return done[below] + (place - static_cast<double>(below)) * (done[below + 1] - done[below]);
}

ExpectedCost expected_cost(const DryingScene& s) {
  ExpectedCost cost;
  double seconds = 0;
  switch (s.integrator) {
    case IntegratorKind::inertial:
      inertial_cost(s, cost, seconds);
      break;
    case IntegratorKind::brownian:
      brownian_cost(s, cost, seconds);
      break;
    case IntegratorKind::stabilised:
      stabilised_cost(s, cost, seconds);
      break;
    case IntegratorKind::implicit:
      implicit_cost(s, cost, seconds);
      break;
  }
  cost.least_seconds = 0.5 * seconds;
  cost.most_seconds = 1.6 * seconds + 0.1;
  cost.memory = memory_of(static_cast<double>(s.radius.size()));
  return cost;
}

std::string expected_cost_text(const DryingScene& s, const ExpectedCost& cost, const Machine& machine) {
  const std::string memory = std::isinf(machine.memory) ? fmt::format("{:.2g} GB of memory", 1e-9 * cost.memory)
                                                        : fmt::format("{:.2g} GB of memory of {:.3g} that are free",
                                                                      1e-9 * cost.memory, 1e-9 * machine.memory);
  return fmt::format("expected: about {} steps, {} on one core{}; {}", rounded(cost.steps),
                     duration_range(cost.least_seconds, cost.most_seconds),
                     !s.estimate_error                  ? ""
                     : s.is(IntegratorKind::stabilised) ? ", and about three quarters as much for the error estimate"
                                                        : ", and about half as much for the error estimate",
                     memory) +
         (cost.most_seconds > 86400
              ? "; --fit-to \"1 h\" prints the scene of a smaller droplet that stands for this one"
              : "");
}

}  // namespace crumble::dryer
