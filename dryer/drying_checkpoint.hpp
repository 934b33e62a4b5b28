// Saves a drying run where it stands, and takes it up again to the same bits.
#pragma once

#include <optional>
#include <string>

#include "common/io/checkpoint.hpp"
#include "dryer/run.hpp"

namespace crumble {

class DryingCheckpoint : public OutputCheckpoint {
 public:
  using OutputCheckpoint::OutputCheckpoint;

  DryingRun resume(const DryingScene& scene) const;
  std::optional<DryingOutcome> companion() const;
  int frames() const;                    // already in the file
  std::int64_t last_frame_step() const;  // step of the last of them

  void save(const DryingRun& run, const std::optional<DryingOutcome>& companion, int frames,
            std::int64_t last_frame_step) const;
};

}  // namespace crumble
