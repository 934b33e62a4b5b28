// How soft the contacts are while a droplet dries with Brownian motion: softer as long as few of them matter.
#pragma once

#include <limits>
#include <vector>

#include "dryer/scene.hpp"

namespace crumble::dryer {

struct SofteningStage {
  double softening;                                             // width of the bond in that of the material's
  int depth;                                                    // 2^depth short steps make a long one
  double most_bonds = std::numeric_limits<double>::infinity();  // per particle; with more the next stage begins
};

// In the liquid all that bonds do is to hold pairs together for a share of the time, and a softer bond of the same
// stickiness does it nearly as well: a much softer one while bonds are few, one of integrator.softening in the packed
// core, where more neighbours lie within its width. What the liquid leaves dry keeps its bonds, and those to its wet
// neighbours break one by one: with the first dry particle the contacts are the material's own. A run that asks for
// full stiffness has it throughout. Only for bonds that thermal motion breaks many times while a particle diffuses its
// radius: others keep the history of how they came about, and have one softening throughout. Where no softer
// contact holds a pair as tightly, the contacts are the material's own from the beginning.
std::vector<SofteningStage> softening_stages(const DryingScene& scene);

// A bond worth hardly more than kT, of small particles or a stiff material, cannot be wider without holding pairs more.
bool can_be_softened(const DryingScene& scene, double softening);

// What the integrator is given: the scene's model, with its contacts softened if particles diffuse.
DryingModel softened_model(const DryingScene& scene, double softening);

}  // namespace crumble::dryer
