// What a run will take, before it is begun.
#pragma once

#include <string>

#include "common/io/machine.hpp"
#include "dryer/scene.hpp"
#include "dryer/work.hpp"

namespace crumble::dryer {

struct ExpectedCost {
  Work work;
  double least_seconds = 0, most_seconds = 0;  // of one core, without the companion run of error.estimate
  double memory = 0;                           // at its peak, bytes
};

// The work is what the scene's integrator expects of it, from steps on a sample of its particles on this processor
// (cost_sample.hpp), some 20 ms in all. The range is that of pipeline/verify/drying_forecast.py, which compares with
// runs.
ExpectedCost expected_cost(const DryingScene& scene);

// "expected: about 1900 steps, 2 to 4 s on one core", and the memory, of what there is.
std::string expected_cost_text(const DryingScene& scene, const ExpectedCost& cost, const Machine& machine);

}  // namespace crumble::dryer
