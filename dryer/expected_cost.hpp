// What a run will take, before it is begun.
#pragma once

#include <array>
#include <string>

#include "common/io/machine.hpp"
#include "dryer/scene.hpp"

namespace crumble::dryer {

struct ExpectedCost {
  double steps = 0;
  double least_seconds = 0, most_seconds = 0;  // of one core, without the companion run of error.estimate
  double memory = 0;                           // at its peak, bytes

  // Share of the work that is done when the front has gone this share of the radius.
  double share(double fraction) const;
  std::array<double, 65> done{};  // at even fractions from 0 to 1
};

// Steps follow from the scene, their time from steps of the integrator on a sample of it on this processor
// (cost_sample.hpp), some 20 ms in all:
//   implicit: a step for each 0.8 of the largest displacement that the front advances, and 5.5 N^0.75 which contacts
//     end; a step grows like N^1.23
//   Brownian: the fixed long steps of each stage of softening. Short steps are for particles that have come to rest at
//     the front, that a neighbour is near, or that bonds hold together
//   stabilised: evaluations: stages of the Chebyshev method, summed over steps that the front makes each in the time of
//     the largest displacement; the fastest rate is some 12 k_s/zeta, or that at which a strong surface catches a
//     particle
//   inertial: the fixed step
// The range is that of pipeline/verify/drying_forecast.py, which compares with runs.
ExpectedCost expected_cost(const DryingScene& scene);

// "expected: about 1900 steps, 2 to 4 s on one core", and the memory, of what there is.
std::string expected_cost_text(const DryingScene& scene, const ExpectedCost& cost, const Machine& machine);

}  // namespace crumble::dryer
