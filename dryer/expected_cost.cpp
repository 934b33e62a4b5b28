#include "dryer/expected_cost.hpp"

#include <fmt/core.h>

#include <cmath>

#include "common/io/progress.hpp"
#include "dryer/cost_sample.hpp"
#include "dryer/inertial.hpp"
#include "dryer/process_inputs.hpp"
#include "dryer/run.hpp"

namespace crumble::dryer {

namespace {

std::string rounded(double steps) {
  return steps < 1e5 ? fmt::format("{:.0f}", std::round(steps / 10) * 10) : fmt::format("{:.1e}", steps);
}

Work brownian_work(const DryingScene& s, const StepTimes& times) {
  std::vector<BrownianStage> stages;
  for (const SofteningStage& stage : softening_stages(s))
    stages.push_back({softened_model(s, stage.softening), stage.depth, stage.most_bonds});
  return Brownian::expected_work(s.model, s.radius, stages, s.brownian.contact_step, times);
}

// Of a packed particle in a short step. Surface forces act in the liquid alone, and half of what is packed lies in it.
double packed_seconds(const DryingScene& s) {
  const double wet = measured_seconds(s, SampleState::packed);
  if (!s.is(IntegratorKind::brownian) || !s.model.surface_forces) return wet;
  DryingScene dry = s;
  dry.model.surface_forces.reset();
  return 0.5 * (wet + measured_seconds(dry, SampleState::packed));
}

Work expected_work(const DryingScene& s) {
  StepTimes times{packed_seconds(s), 0, static_cast<double>(sample_size(s))};
  if (s.is(IntegratorKind::inertial) || s.is(IntegratorKind::brownian))
    times.loose = measured_seconds(s, SampleState::loose);
  switch (s.integrator) {
    case IntegratorKind::inertial:
      return Inertial::expected_work(s.model, s.radius, s.step, times);
    case IntegratorKind::implicit:
      return Implicit::expected_work(s.model, s.radius, s.implicit, times);
    case IntegratorKind::stabilised:
      return Stabilised::expected_work(s.model, s.radius, s.stabilised, times);
    case IntegratorKind::brownian:
      break;
  }
  return brownian_work(s, times);
}

}  // namespace

ExpectedCost expected_cost(const DryingScene& s) {
  ExpectedCost cost;
  cost.work = expected_work(s);
  cost.least_seconds = 0.5 * cost.work.seconds;
  cost.most_seconds = 1.6 * cost.work.seconds + 0.1;
  cost.memory = memory_of(static_cast<double>(s.radius.size()));
  return cost;
}

std::string expected_cost_text(const DryingScene& s, const ExpectedCost& cost, const Machine& machine) {
  const std::string memory = std::isinf(machine.memory) ? fmt::format("{:.2g} GB of memory", 1e-9 * cost.memory)
                                                        : fmt::format("{:.2g} GB of memory of {:.3g} that are free",
                                                                      1e-9 * cost.memory, 1e-9 * machine.memory);
  return fmt::format("expected: about {} steps, {} on one core{}; {}", rounded(cost.work.steps),
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
