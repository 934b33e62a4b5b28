#include "dryer/run.hpp"

#include "dryer/brownian.hpp"
#include "dryer/inertial.hpp"
#include "dryer/pair_statistics.hpp"
#include "dryer/start.hpp"

namespace crumble {

namespace {

std::unique_ptr<Integrator> make_integrator(const DryingScene& scene, const DryingModel& model, double coarsening,
                                            Agglomerate& state) {
  if (scene.inertial) return std::make_unique<Inertial>(model, state, coarsening * scene.step, scene.seed);
  if (model.thermal_energy > 0) {
    BrownianControl control = scene.brownian;
    control.contact_step *= coarsening;
    return std::make_unique<Brownian>(model, state, scene.seed, control);
  }
  OverdampedControl control = scene.control;
  control.largest_displacement *= coarsening;
  control.contact_precision *= coarsening;
  return std::make_unique<Overdamped>(model, state, control);
}

}  // namespace

DryingModel effective_model(const DryingScene& scene) {
  DryingModel model = scene.model;
  if (scene.softens_contacts())
    model.material = softened(model.material, scene.smallest_radius(), model.thermal_energy, scene.softening);
  return model;
}

DryingRun::DryingRun(const DryingScene& scene, double coarsening, Agglomerate state)
    : scene_(scene),
      model_(effective_model(scene)),
      state_(std::move(state)),
      integrator_(make_integrator(scene, model_, coarsening, state_)) {}

DryingRun::DryingRun(const DryingScene& scene, double coarsening)
    : DryingRun(scene, coarsening,
                random_suspension(scene.radius, scene.model.material.density, scene.model.droplet.initial_radius,
                                  scene.seed)) {}

DryingRun::DryingRun(const DryingScene& scene, double coarsening, Agglomerate state, const Integrator::Memory& memory)
    : DryingRun(scene, coarsening, std::move(state)) {
  integrator_->recall(memory);
}

DryingRun::Surface DryingRun::surface() const {
  Surface surface;
  const double R = droplet_radius();
  for (std::size_t p = 0; p < state_.particles.size(); ++p) {
    const double a = state_.particles.radius[p], r = state_.state.position[p].norm();
    if (!surface_cuts(a, r, R)) continue;
    ++surface.wetted;
    surface.largest_force =
        std::max(surface.largest_force, capillary_force(scene_.model.droplet.surface_tension, a, r - R));
  }
  return surface;
}

DryingOutcome outcome(const Morphology& m) {
  return {m.extent.diameter(), m.extent.relative_crust(), static_cast<double>(m.contacts)};
}

}  // namespace crumble
