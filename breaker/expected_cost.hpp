// What a breakup will take, before it is begun.
#pragma once

#include <string>

#include "breaker/integrator.hpp"
#include "breaker/start.hpp"

namespace crumble::breaker {

struct ExpectedCost {
  ExpectedSteps steps;      // as the integrator expects them
  double step_seconds = 0;  // CPU, of one thread
};

// The time of a step is measured on the scene itself: steps of its own run from the start, until some contact has
// yielded and a fifth of a second is used up.
ExpectedCost expected_cost(const BreakerScene& scene, const Start& start);

// "expected: 800 to 4000 steps of 1.4 ms, 1 to 6 s for one run"
std::string expected_cost_text(const ExpectedCost& cost);

}  // namespace crumble::breaker
