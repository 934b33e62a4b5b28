// One drying, from the filled droplet to the dry granule.
#pragma once

#include <memory>
#include <optional>

#include "common/agglomerate/morphology.hpp"
#include "dryer/integrator.hpp"
#include "dryer/scene.hpp"
#include "dryer/softening.hpp"

namespace crumble::dryer {

// The scene's integrator for a state. coarsening: factor on its step control; depth: of Brownian steps.
std::unique_ptr<Integrator> make_integrator(const DryingScene& scene, const DryingModel& model, double coarsening,
                                            int depth, Agglomerate& state);

// Throws what a run of the scene would at its start, without making all of a large one: the start is filled in
// descending order of the radii, and the first 20,000 particles are those of the whole. More of equal ones take at most
// 32 % of what centres can take (30 % of the droplet is solids at most), where random addition still finds places.
void check_start(const DryingScene& scene);

class DryingRun {
 public:
  // coarsening: factor on the step control; 1 for the run itself, 2 for the companion that measures its error.
  DryingRun(const DryingScene& scene, double coarsening);

  // A run that goes on from a saved state. Throws SavedFieldError if fields are missing or left over.
  DryingRun(const DryingScene& scene, double coarsening, SavedFields saved);
  DryingRun(const DryingRun&) = delete;  // the integrator refers to the model and the state
  DryingRun& operator=(const DryingRun&) = delete;

  void step();
  bool finished() const { return state_.state.time >= integrator_->front().end(); }

  double droplet_radius() const { return integrator_->front().radius(state_.state.time); }
  std::optional<double> temperature() const;  // of the liquid as [gas] has it, K
  double fraction() const { return 1 - droplet_radius() / scene_.model.droplet.initial_radius; }
  // How many of the scene's frames the front has come to.
  int frames_passed() const;

  const Agglomerate& state() const { return state_; }
  void save(SavedFields f);
  const Integrator& integrator() const { return *integrator_; }
  std::size_t stage() const { return stage_; }  // of the softening, softening.hpp

  // Particles that the surface cuts, and the largest capillary force on one, N.
  struct Surface {
    std::int64_t wetted = 0;
    double largest_force = 0;
  };
  Surface surface() const;

 private:
  struct Begin {
    Agglomerate state;
    std::size_t stage = 0, piece = 0;
  };
  static Begin saved_begin(const DryingScene& scene, SavedFields& saved);
  DryingRun(const DryingScene& scene, double coarsening, Begin begin);
  double latest_time() const;
  bool outgrows_stage() const;
  void enter(std::size_t stage, std::size_t piece);
  DryingModel model_now() const;

  const DryingScene& scene_;
  double coarsening_;
  std::vector<SofteningStage> stages_;
  std::size_t stage_, piece_;  // piece: of scene_.liquid
  DryingModel model_;
  Agglomerate state_;
  std::unique_ptr<Integrator> integrator_;
};

// What a run came to; the companion run of the error estimate leaves just this.
struct DryingOutcome {
  double d_c = 0, h_c_over_d_c = 0, contacts = 0;
};
DryingOutcome outcome(const Morphology& morphology);

}  // namespace crumble::dryer
