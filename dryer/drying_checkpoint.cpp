#include "dryer/drying_checkpoint.hpp"

namespace crumble::dryer {

void DryingProgress::fields(SavedFields& f) {
  f("estimated", estimated);
  f("frames", frames);
  std::vector<DryingOutcome> done;
  if (companion) done.push_back(*companion);
  f.size("companion", done);
  f.column("companion.d_c", done, &DryingOutcome::d_c);
  f.column("companion.h_c_over_d_c", done, &DryingOutcome::h_c_over_d_c);
  f.column("companion.contacts", done, &DryingOutcome::contacts);
  if (!done.empty()) companion = done.front();
}

double coarsening(const DryingProgress& progress) { return progress.estimated ? 1 : 2; }

void save_drying(SavedFields& f, DryingProgress& progress, DryingRun& run) {
  SavedFields beside = f.in("progress");
  progress.fields(beside);
  run.save(f.in("run"));
}

SavedDrying saved_drying(const OutputCheckpoint& checkpoint, const DryingScene& scene) {
  return checkpoint.restored([&](SavedFields& f) {
    SavedDrying saved;
    saved.frames.fields(f.in("frames"));
    SavedFields beside = f.in("progress");
    saved.progress.fields(beside);
    saved.run = std::make_unique<DryingRun>(scene, coarsening(saved.progress), f.in("run"));
    return saved;
  });
}

}  // namespace crumble::dryer
