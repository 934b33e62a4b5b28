// What a breakup will take, before it is begun.
#pragma once

#include <string>

#include "breaker/start.hpp"

namespace crumble::breaker {

struct ExpectedCost {
  double least_steps = 0, most_steps = 0;
  double step_seconds = 0;  // CPU, of one thread
};

// The time of a step is measured on the scene itself: steps of its own run from the start, until some contact has
// yielded and a fifth of a second is used up. How many it takes is not known before it has broken: per contact between
// the least and the most of pipeline/verify/ramp.md, from a chain of three to granules of 115, for soft and
// stiff material, weak and strong bonds.
ExpectedCost expected_cost(const BreakerScene& scene, const Start& start);

// "expected: 800 to 4000 steps of 1.4 ms, 1 to 6 s for one run"
std::string expected_cost_text(const ExpectedCost& cost);

}  // namespace crumble::breaker
