// How fast an integrator is on this processor: a small sample of the scene's own particles, stepped for milliseconds.
#pragma once

#include "dryer/scene.hpp"

namespace crumble::dryer {

// Up to two hundred particles, of radii evenly taken from the scene's.
enum class SampleState {
  loose,  // a random start at the scene's share of solids, at most 10 %
  packed  // a simple cubic lattice, two of three places taken: four neighbours each, all bonded, within the surface
};

// CPU seconds of one thread for a particle and step of the integrator that will run, the median of some steps; for
// Brownian motion of one short step, or in the loose state of one long step.
double measured_seconds(const DryingScene& scene, SampleState state);

// How many particles the sample has.
std::size_t sample_size(const DryingScene& scene);

}  // namespace crumble::dryer
