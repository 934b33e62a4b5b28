#include "dryer/run.hpp"

#include <algorithm>

#include "dryer/brownian.hpp"
#include "dryer/inertial.hpp"
#include "dryer/start.hpp"

namespace crumble {

std::unique_ptr<Integrator> make_integrator(const DryingScene& scene, const DryingModel& model, double coarsening,
                                            int depth, Agglomerate& state) {
  switch (scene.integrator) {
    case IntegratorKind::inertial:
      return std::make_unique<Inertial>(model, state, coarsening * scene.step, scene.seed);
    case IntegratorKind::brownian: {
      BrownianControl control = scene.brownian;
      control.contact_step *= coarsening;
      control.depth = depth;
      return std::make_unique<Brownian>(model, state, scene.seed, control);
    }
    case IntegratorKind::stabilised: {
      StabilisedControl control = scene.stabilised;
      control.largest_displacement *= coarsening;
      return std::make_unique<Stabilised>(model, state, control);
    }
    case IntegratorKind::implicit:
      break;
  }
  ImplicitControl control = scene.implicit;
  control.largest_displacement *= coarsening;
  control.contact_precision *= coarsening;
  return std::make_unique<Implicit>(model, state, control);
}

DryingRun::DryingRun(const DryingScene& scene, double coarsening, Agglomerate state, std::size_t stage)
    : scene_(scene),
      coarsening_(coarsening),
      stages_(softening_stages(scene)),
      stage_(stage),
      model_(softened_model(scene, stages_.at(stage).softening)),
      state_(std::move(state)),
      integrator_(make_integrator(scene, model_, coarsening, stages_.at(stage).depth, state_)) {}

DryingRun::DryingRun(const DryingScene& scene, double coarsening)
    : DryingRun(
          scene, coarsening,
          random_suspension(scene.radius, scene.model.material.density, scene.model.droplet.initial_radius, scene.seed),
          0) {}

DryingRun::DryingRun(const DryingScene& scene, double coarsening, Agglomerate state, const Integrator::Memory& memory,
                     std::size_t stage)
    : DryingRun(scene, coarsening, std::move(state), stage) {
  integrator_->recall(memory);
}

int DryingRun::frames_passed() const {
  constexpr double rounding = 1e-9;
  const auto& frames = scene_.frames;
  return static_cast<int>(std::upper_bound(frames.begin(), frames.end(), fraction() + rounding) - frames.begin());
}

// Steps of free length end at frames; those with Brownian motion or inertia are much shorter.
double DryingRun::latest_time() const {
  const Front& front = integrator_->front();
  const auto next = static_cast<std::size_t>(frames_passed());
  const bool free = scene_.is(IntegratorKind::implicit) || scene_.is(IntegratorKind::stabilised);
  if (!free || next == scene_.frames.size()) return front.end();
  return std::min(front.end(), front.time_at((1 - scene_.frames[next]) * scene_.model.droplet.initial_radius));
}

void DryingRun::step() {
  integrator_->step(latest_time());
  if (stage_ + 1 < stages_.size() && outgrows_stage()) enter_next_stage();
}

bool DryingRun::outgrows_stage() const {
  const std::size_t number = state_.particles.size();
  const double R = droplet_radius();
  if (static_cast<double>(state_.state.contacts.size()) > stages_[stage_].most_bonds * static_cast<double>(number))
    return true;
  for (std::size_t p = 0; p < number; ++p)
    if (is_dry(state_.particles.radius[p], state_.state.position[p].norm(), R)) return true;
  return false;
}

void DryingRun::enter_next_stage() {
  const Integrator::Memory memory = integrator_->memory();
  ++stage_;
  model_ = softened_model(scene_, stages_[stage_].softening);
  integrator_ = make_integrator(scene_, model_, coarsening_, stages_[stage_].depth, state_);
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
