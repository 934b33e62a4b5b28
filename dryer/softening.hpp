// How soft the contacts are while a droplet dries with Brownian motion: softer as long as few of them matter.
#pragma once

#include <limits>
#include <vector>

#include "dryer/scene.hpp"

namespace crumble {

struct SofteningStage {
  double softening;                                             // width of the bond in that of the material's
  int depth;                                                    // 2^depth short steps make a long one
  double most_bonds = std::numeric_limits<double>::infinity();  // per particle; with more, the next stage begins
};

// While bonds are few, all that they do to the suspension is to hold pairs together for a share of the time, and a much
// softer bond of the same stickiness does it as well; only in the packed core does their width count, because more
// neighbours lie within it. So a run whose integrator.softening is above 1 begins with factors of 4 and 2.5 and
// ends with its own; one that asks for full stiffness has it throughout. The last stage also begins as soon as a
// particle is left dry. Only for bonds that thermal motion breaks many times while a particle diffuses its radius:
// others keep the history of how they came about.
std::vector<SofteningStage> softening_stages(const DryingScene& scene);

// What the integrator is given: the scene's model, with its contacts softened if particles diffuse.
DryingModel softened_model(const DryingScene& scene, double softening);

}  // namespace crumble
