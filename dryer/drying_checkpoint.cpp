#include "dryer/drying_checkpoint.hpp"

namespace crumble::dryer {

void DryingProgress::fields(SavedFields& f) {
  f("frames", frames);
  f("last_frame_step", last_frame_step);
  std::vector<DryingOutcome> done;
  if (companion) done.push_back(*companion);
  f.size("companion", done);
  f.column("companion.d_c", done, &DryingOutcome::d_c);
  f.column("companion.h_c_over_d_c", done, &DryingOutcome::h_c_over_d_c);
  f.column("companion.contacts", done, &DryingOutcome::contacts);
  if (!done.empty()) companion = done.front();
}

void DryingCheckpoint::save(DryingRun& run, DryingProgress progress) const {
  store([&](SavedFields& f) {
    progress.fields(f);
    run.save(f.in("run"));
  });
}

DryingProgress DryingCheckpoint::progress() const {
  return restored([](SavedFields& f) {
    DryingProgress progress;
    progress.fields(f);
    return progress;
  });
}

DryingRun DryingCheckpoint::resume(const DryingScene& scene) const {
  return restored([&](SavedFields& f) {
    DryingProgress().fields(f);
    return DryingRun(scene, f.in("run"));
  });
}

}  // namespace crumble::dryer
