#include "dryer/run.hpp"

#include <algorithm>

#include "common/agglomerate/saved_frame.hpp"
#include "dryer/brownian.hpp"
#include "dryer/inertial.hpp"
#include "dryer/start.hpp"

namespace crumble::dryer {

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
      control.brownian_displacement *= coarsening;
      return std::make_unique<Stabilised>(model, state, control, scene.seed);
    }
    case IntegratorKind::implicit:
      break;
  }
  ImplicitControl control = scene.implicit;
  control.largest_displacement *= coarsening;
  control.contact_precision *= coarsening;
  return std::make_unique<Implicit>(model, state, control);
}

void check_start(const DryingScene& scene) {
  constexpr std::size_t enough = 20000;
  DryingScene first = scene;
  if (first.radius.size() > enough) first.radius.resize(enough);
  const DryingRun builds(first, 1);
  for (const SofteningStage& stage : softening_stages(scene)) softened_model(scene, stage.softening);
}

DryingRun::DryingRun(const DryingScene& scene, double coarsening, Begin begin)
    : scene_(scene),
      coarsening_(coarsening),
      stages_(softening_stages(scene)),
      stage_(begin.stage),
      piece_(begin.piece),
      model_(model_now()),
      state_(std::move(begin.state)),
      integrator_(make_integrator(scene, model_, coarsening, stages_[stage_].depth, state_)) {}

DryingRun::DryingRun(const DryingScene& scene, double coarsening)
    : DryingRun(scene, coarsening,
                Begin{random_suspension(scene.radius, scene.model.material.density, scene.model.droplet.initial_radius,
                                        scene.seed)}) {}

namespace {

void begin_fields(SavedFields& f, const DryingScene& scene, std::size_t& stage, std::size_t& piece, Frame& frame) {
  f("softening_stage", stage);
  if (!scene.liquid.empty()) f("liquid_piece", piece);
  saved_frame(f.in("state"), frame);
}

}  // namespace

DryingRun::Begin DryingRun::saved_begin(const DryingScene& scene, SavedFields& saved) {
  Begin begin;
  begin.state.particles = suspended_particles(scene.radius, scene.model.material.density);
  begin_fields(saved, scene, begin.stage, begin.piece, begin.state.state);
  return begin;
}

DryingRun::DryingRun(const DryingScene& scene, double coarsening, SavedFields saved)
    : DryingRun(scene, coarsening, saved_begin(scene, saved)) {
  SavedFields f = saved.in("integrator");
  integrator_->fields(f);
  saved.require_all_read();
}

void DryingRun::save(SavedFields f) {
  begin_fields(f, scene_, stage_, piece_, state_.state);
  SavedFields inside = f.in("integrator");
  integrator_->fields(inside);
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
  double latest = front.end();
  if (!free) return latest;
  if (next < scene_.frames.size())
    latest = std::min(latest, front.time_at((1 - scene_.frames[next]) * scene_.model.droplet.initial_radius));
  if (piece_ + 1 < scene_.liquid.size()) latest = std::min(latest, front.time_of(scene_.liquid[piece_].until));
  return latest;
}

void DryingRun::step() {
  integrator_->step(latest_time());
  const std::size_t stage = stage_ + (stage_ + 1 < stages_.size() && outgrows_stage() ? 1 : 0);
  std::size_t piece = piece_;
  if (!scene_.liquid.empty() && !finished())
    piece += pieces_passed(scene_.liquid, piece_, integrator_->front().reduced(state_.state.time));
  if (stage != stage_ || piece != piece_) enter(stage, piece);
}

std::optional<double> DryingRun::temperature() const {
  if (!scene_.gas) return std::nullopt;
  return scene_.model.droplet.curve->temperature(integrator_->front().reduced(state_.state.time));
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

// The scene's, softened, with what the liquid is now. How soft contacts are follows from the scene's own kT.
DryingModel DryingRun::model_now() const {
  DryingModel model = softened_model(scene_, stages_.at(stage_).softening);
  if (!scene_.liquid.empty()) take(scene_.liquid.at(piece_), model);
  return model;
}

void DryingRun::enter(std::size_t stage, std::size_t piece) {
  SavedState kept = crumble::save(*integrator_);
  integrator_.reset();
  stage_ = stage, piece_ = piece;
  model_ = model_now();
  integrator_ = make_integrator(scene_, model_, coarsening_, stages_[stage_].depth, state_);
  load(*integrator_, std::move(kept));
}

DryingRun::Surface DryingRun::surface() const {
  Surface surface;
  const double R = droplet_radius();
  for (std::size_t p = 0; p < state_.particles.size(); ++p) {
    const double a = state_.particles.radius[p], r = state_.state.position[p].norm();
    if (!surface_cuts(a, r, R)) continue;
    ++surface.wetted;
    surface.largest_force = std::max(surface.largest_force, capillary_force(model_.droplet.surface_tension, a, r - R));
  }
  return surface;
}

DryingOutcome outcome(const Morphology& m) {
  return {m.extent.diameter(), m.extent.relative_crust(), static_cast<double>(m.contacts)};
}

}  // namespace crumble::dryer
