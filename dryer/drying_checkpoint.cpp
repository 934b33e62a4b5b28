#include "dryer/drying_checkpoint.hpp"

#include "common/io/frame_checkpoint.hpp"
#include "dryer/start.hpp"

namespace crumble {

void DryingCheckpoint::save(const DryingRun& run, const std::optional<DryingOutcome>& companion, int frames,
                            std::int64_t last_frame_step) const {
  Checkpoint out;
  out.integers["frames"] = {frames, last_frame_step};
  store_frame(run.state().state, "state", out);
  out.integers["softening_stage"] = {static_cast<std::int64_t>(run.stage())};
  const Integrator::Memory memory = run.integrator().memory();
  out.reals["integrator"] = memory.numbers;
  out.reals["front"] = {memory.front.time, memory.front.reduced, memory.front.rate};
  out.integers["integrator_counts"] = memory.counts;
  out.integers["active"].assign(memory.active.begin(), memory.active.end());
  if (companion) out.reals["companion"] = {companion->d_c, companion->h_c_over_d_c, companion->contacts};
  store(out);
}

DryingRun DryingCheckpoint::resume(const DryingScene& scene) const {
  Agglomerate state =
      random_suspension(scene.radius, scene.model.material.density, scene.model.droplet.initial_radius, scene.seed);
  state.state = restore_frame(stored(), "state");
  Integrator::Memory memory;
  memory.numbers = stored().real("integrator");
  const auto& front = stored().real("front");
  memory.front = {front.at(0), front.at(1), front.at(2)};
  memory.counts = stored().integer("integrator_counts");
  memory.active.assign(stored().integer("active").begin(), stored().integer("active").end());
  const auto stage = static_cast<std::size_t>(stored().integer("softening_stage").at(0));
  return DryingRun(scene, 1, std::move(state), memory, stage);
}

std::optional<DryingOutcome> DryingCheckpoint::companion() const {
  if (!stored().reals.contains("companion")) return std::nullopt;
  const auto& c = stored().real("companion");
  return DryingOutcome{c.at(0), c.at(1), c.at(2)};
}

int DryingCheckpoint::frames() const { return static_cast<int>(stored().integer("frames").at(0)); }
std::int64_t DryingCheckpoint::last_frame_step() const { return stored().integer("frames").at(1); }

}  // namespace crumble
