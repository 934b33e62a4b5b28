#include "breaker/breakup_checkpoint.hpp"

namespace crumble::breaker {

void Progression::fields(SavedFields& f) {
  f("next_sample", next_sample);
  f("next_frame", next_frame);
  f("last_sample", last_sample);
  f("last_frame", last_frame);
  f("companion", companion);
  f("halvings", halvings);
}

void save_breakup(SavedFields& f, Progression& progression, SavedState companion, BreakupRun& run) {
  SavedFields beside = f.in("progression");
  progression.fields(beside);
  f.part("companion", companion);
  SavedFields inside = f.in("run");
  run.fields(inside);
}

SavedBreakup saved_breakup(const OutputCheckpoint& checkpoint) {
  return checkpoint.restored([](SavedFields& f) {
    SavedBreakup saved;
    saved.frames.fields(f.in("frames"));
    SavedFields beside = f.in("progression");
    saved.progression.fields(beside);
    f.part("companion", saved.companion);
    f.part("run", saved.run);
    f.require_all_read();
    return saved;
  });
}

void resume(BreakupRun& run, const OutputCheckpoint& checkpoint, SavedState state) {
  checkpoint.restored([&](SavedFields&) { load(run, std::move(state)); });
}

}  // namespace crumble::breaker
