// Saves a drying run where it stands, and takes it up again to the same bits.
#pragma once

#include <optional>
#include <string>

#include "common/io/checkpoint.hpp"
#include "dryer/run.hpp"

namespace crumble {

// OUTPUT.checkpoint beside the unfinished output.
class DryingCheckpoint {
 public:
  // Finds a checkpoint of `output`, if there is one; throws InputError if it belongs to another scene or version.
  DryingCheckpoint(const std::string& output, CheckpointOwner owner);

  bool found() const { return found_; }
  const std::string& path() const { return path_; }
  // Throws InputError if none was found.
  void require() const;

  DryingRun resume(const DryingScene& scene) const;
  std::optional<DryingOutcome> companion() const;
  int frames() const;                    // already in the file
  std::int64_t last_frame_step() const;  // step of the last of them

  void save(const DryingRun& run, const std::optional<DryingOutcome>& companion, int frames,
            std::int64_t last_frame_step) const;
  void remove() const;

 private:
  std::string path_;
  CheckpointOwner owner_;
  bool found_ = false;
  Checkpoint stored_;
};

}  // namespace crumble
