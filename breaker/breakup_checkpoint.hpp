// Saves a breakup where it stands, and takes it up again to the same bits.
#pragma once

#include <optional>

#include "breaker/run.hpp"
#include "common/io/checkpoint.hpp"

namespace crumble::breaker {

// What main keeps beside the run.
struct Progression {
  double next_sample = 0, next_frame = 0;  // Pa
  std::int64_t last_step = -1;             // of the last frame or sample in the file
  std::optional<double> companion;  // critical stress of the same run with coarser control, Pa; infinite: nothing broke
  std::int64_t halvings = 0;        // of the tolerance, since the error was too large

  void fields(SavedFields& f);
};

class BreakupCheckpoint : public OutputCheckpoint {
 public:
  using OutputCheckpoint::OutputCheckpoint;

  Progression progression() const;
  void resume(BreakupRun& run) const;
  void save(BreakupRun& run, Progression progression) const;
};

}  // namespace crumble::breaker
