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

// OUTPUT.checkpoint beside the unfinished output.
class BreakupCheckpoint {
 public:
  // Finds a checkpoint of `output`, if there is one; throws InputError if it belongs to another scene or version.
  BreakupCheckpoint(const std::string& output, CheckpointOwner owner);

  bool found() const { return found_; }
  const std::string& path() const { return path_; }
  // Throws InputError if none was found.
  void require() const;
  void resume(BreakupRun& run, Progression& progression) const;
  void save(const BreakupRun& run, const Progression& progression) const;
  void remove() const;

 private:
  std::string path_;
  CheckpointOwner owner_;
  bool found_ = false;
  Checkpoint stored_;
};

}  // namespace crumble
