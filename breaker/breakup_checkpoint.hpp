// Takes a breakup up again where it stood, to the same bits.
#pragma once

#include <optional>

#include "breaker/run.hpp"
#include "common/io/checkpoint.hpp"
#include "common/io/frame_log.hpp"

namespace crumble::breaker {

// What main keeps beside the run.
struct Progression {
  double next_sample = 0, next_frame = 0;         // Pa; along a history, s
  std::int64_t last_sample = 0, last_frame = -1;  // steps at which they were written
  std::optional<double> companion;  // outcome of the same run with coarser control; infinite: nothing broke
  std::int64_t halvings = 0;        // of the tolerance, since the error was too large

  void fields(SavedFields& f);
};

struct SavedBreakup {
  FrameLog::Mark frames;
  Progression progression;
  SavedState companion;  // while it runs
  SavedState run;
};

void save_breakup(SavedFields& f, Progression& progression, SavedState companion, BreakupRun& run);
SavedBreakup saved_breakup(const OutputCheckpoint& checkpoint);
// Throws InputError naming the field that is missing or not known.
void resume(BreakupRun& run, const OutputCheckpoint& checkpoint, SavedState state);

}  // namespace crumble::breaker
