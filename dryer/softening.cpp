#include "dryer/softening.hpp"

#include <stdexcept>

#include "dryer/drag.hpp"
#include "dryer/pair_statistics.hpp"

namespace crumble::dryer {

namespace {

// Bonds last less than a hundredth of the time in which a particle diffuses its radius.
bool bonds_are_brief(const DryingScene& scene) {
  const double a = scene.smallest_radius(), kT = scene.model.thermal_energy;
  const double D = kT / drag_coefficient(scene.model.viscosity, a);
  return pair_statistics(Jkr(scene.model.material, a), kT, 2 * D).lifetime < 0.01 * a * a / D;
}

}  // namespace

bool can_be_softened(const DryingScene& scene, double factor) {
  try {
    softened_model(scene, factor);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

std::vector<SofteningStage> softening_stages(const DryingScene& scene) {
  const int depth = scene.brownian.depth;
  const bool soft = scene.is(IntegratorKind::brownian) && can_be_softened(scene, scene.softening);
  const SofteningStage packed{soft ? scene.softening : 1, depth};
  if (!scene.is(IntegratorKind::brownian) || packed.softening == 1 || !bonds_are_brief(scene)) return {packed};
  std::vector<SofteningStage> stages;
  for (const SofteningStage& stage : {SofteningStage{4, 5, 0.3}, SofteningStage{2.5, 5, 1}})
    if (stage.softening > scene.softening && can_be_softened(scene, stage.softening)) stages.push_back(stage);
  stages.push_back(packed);
  stages.push_back({1, depth + 1});  // a long step about as long as before: the short ones are half as long
  return stages;
}

DryingModel softened_model(const DryingScene& scene, double softening) {
  DryingModel model = scene.model;
  if (scene.is(IntegratorKind::brownian))
    model.material = softened(model.material, scene.smallest_radius(), model.thermal_energy, softening);
  return model;
}

}  // namespace crumble::dryer
