#include "breaker/breakup_checkpoint.hpp"

namespace crumble::breaker {

void Progression::fields(SavedFields& f) {
  f("next_sample", next_sample);
  f("next_frame", next_frame);
  f("last_step", last_step);
  f("companion", companion);
  f("halvings", halvings);
}

void BreakupCheckpoint::save(BreakupRun& run, Progression progression) const {
  store([&](SavedFields& f) {
    progression.fields(f);
    SavedFields inside = f.in("run");
    run.fields(inside);
  });
}

Progression BreakupCheckpoint::progression() const {
  return restored([](SavedFields& f) {
    Progression progression;
    progression.fields(f);
    return progression;
  });
}

void BreakupCheckpoint::resume(BreakupRun& run) const {
  restored([&](SavedFields& f) {
    Progression().fields(f);
    SavedFields inside = f.in("run");
    run.fields(inside);
    f.require_all_read();
  });
}

}  // namespace crumble::breaker
