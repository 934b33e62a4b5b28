// Saves a drying run where it stands, and takes it up again to the same bits.
#pragma once

#include <optional>

#include "common/io/checkpoint.hpp"
#include "dryer/run.hpp"

namespace crumble::dryer {

// What main keeps beside the run.
struct DryingProgress {
  int frames = 0;                    // already in the file
  std::int64_t last_frame_step = 0;  // of the last of them
  std::optional<DryingOutcome> companion;
  void fields(SavedFields& f);
};

class DryingCheckpoint : public OutputCheckpoint {
 public:
  using OutputCheckpoint::OutputCheckpoint;

  DryingProgress progress() const;
  DryingRun resume(const DryingScene& scene) const;
  void save(DryingRun& run, DryingProgress progress) const;
};

}  // namespace crumble::dryer
