// Takes a drying run up again where it stood, to the same bits.
#pragma once

#include <memory>
#include <optional>

#include "common/io/checkpoint.hpp"
#include "common/io/frame_log.hpp"
#include "dryer/run.hpp"

namespace crumble::dryer {

// What main keeps beside the run.
struct DryingProgress {
  bool estimated = false;                  // the error estimate, which comes first, is over
  std::optional<DryingOutcome> companion;  // what it came to
  int frames = 0;                          // already in the log
  void fields(SavedFields& f);
};

// The run that is under way is the companion of the error estimate or, with that over, the run itself.
void save_drying(SavedFields& f, DryingProgress& progress, DryingRun& run);

struct SavedDrying {
  FrameLog::Mark frames;
  DryingProgress progress;
  std::unique_ptr<DryingRun> run;
};
SavedDrying saved_drying(const OutputCheckpoint& checkpoint, const DryingScene& scene);

// Factor on the step control of the run that is under way.
double coarsening(const DryingProgress& progress);

}  // namespace crumble::dryer
