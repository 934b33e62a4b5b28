#include "breaker/expected_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <vector>

#include "breaker/run.hpp"
#include "common/io/cost.hpp"
#include "common/io/progress.hpp"

namespace crumble::breaker {

namespace {

constexpr double budget = 0.2;  // s; a begun step is ended
constexpr std::size_t most_samples = 40;

// Steps before the first contact yields are of a body that is rigid but for elastic contacts, and cheaper.
double measured_step(BreakupRun& run) {
  std::vector<double> rigid, flexible;
  const double begin = thread_seconds();
  double before = begin;
  while (!run.finished() && flexible.size() < most_samples) {
    try {
      run.step();
    } catch (const std::exception&) {
      break;  // the run itself will say so, and keep its state
    }
    const double now = thread_seconds();
    (run.breakup().first_limit ? flexible : rigid).push_back(now - before);
    before = now;
    if (now - begin > budget && rigid.size() + flexible.size() > 2) break;
  }
  std::vector<double>& times = flexible.size() > 2 ? flexible : rigid;
  if (times.empty()) return 0;
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

}  // namespace

ExpectedCost expected_cost(const BreakerScene& scene, const Start& start) {
  BreakupRun run(scene, start.agglomerate, 1);
  const ExpectedSteps steps = run.expected_steps();
  return {steps, measured_step(run)};
}

std::string expected_cost_text(const ExpectedCost& c) {
  if (c.steps.most == 0)
    return fmt::format("expected: steps of {:.2g} ms; how many is not known", 1e3 * c.step_seconds);
  return fmt::format("expected: {:.2g} to {:.2g} steps of {:.2g} ms, {} for one run", c.steps.least, c.steps.most,
                     1e3 * c.step_seconds,
                     duration_range(c.steps.least * c.step_seconds, c.steps.most * c.step_seconds));
}

}  // namespace crumble::breaker
