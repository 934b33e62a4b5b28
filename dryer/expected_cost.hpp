// What a run will take, before it is begun.
#pragma once

#include <string>

#include "dryer/scene.hpp"

namespace crumble {

struct ExpectedCost {
  double steps = 0;
  double seconds = 0;  // on one core, without the companion run of error.estimate
};

// From counts and times of runs of ours (November 2026, Intel Xeon, one core):
//   implicit: one step for each 0.8 of the largest displacement that the front advances, and 5.5 for each
//     particle, whose contacts end steps; 6 microseconds a particle and step at N = 30, 9 at 115, 12 at 400
//   overdamped, Brownian: the fixed steps of each stage of softening; 0.005 microseconds a particle and short step
//     while bonds are few, 0.05 in the packed core, N = 85 to 102
//   stabilised: evaluations, 24 nanoseconds a particle and evaluation, N = 115 and 1000
//   inertial: fixed step; 0.05 microseconds a particle and step
// Steps at D = 0 agree within 30 % for N = 30 to 10,000, but are up to three times as many where a strong surface
// tension presses contacts together; take the time as right within a factor of 2 to 3.
ExpectedCost expected_cost(const DryingScene& scene);

// "expected: about 1900 steps, 2 s on one core".
std::string expected_cost_text(const DryingScene& scene);

}  // namespace crumble
