// Saves a breakup where it stands, and takes it up again to the same bits.
#pragma once

#include <optional>
#include <string>

#include "breaker/run.hpp"
#include "common/io/checkpoint.hpp"

namespace crumble {

// What main keeps beside the run.
struct Progression {
  double next_sample = 0, next_frame = 0;  // Pa
  std::int64_t last_step = -1;             // of the last frame or sample in the file
  std::optional<double> companion;         // critical stress of the companion, Pa; -1: it did not break
};

class BreakupCheckpoint : public OutputCheckpoint {
 public:
  using OutputCheckpoint::OutputCheckpoint;

  void resume(BreakupRun& run, Progression& progression) const;
  void save(const BreakupRun& run, const Progression& progression) const;
};

}  // namespace crumble
