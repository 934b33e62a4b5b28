// The exact state of an interrupted run, private to the program that wrote it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/io/cost.hpp"

namespace crumble {

// Arrays by name, in the program's own units, stored to the bit under /restart.
struct Checkpoint {
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<std::int64_t>> integers;

  // Throw ContentError naming the array if it is missing.
  const std::vector<double>& real(const std::string& name) const;
  const std::vector<std::int64_t>& integer(const std::string& name) const;
};

// Who may continue: the same program, version and resolved scene.
struct CheckpointOwner {
  std::string program, version, scene;  // scene: the resolved text
};

// Written under a temporary name and renamed: there is always one whole checkpoint or none.
void save_checkpoint(const std::filesystem::path& path, const CheckpointOwner& owner, const Checkpoint& checkpoint);

// Throws InputError saying which of program, version and scene differs and what to do, ContentError if the file is not
// a checkpoint.
Checkpoint load_checkpoint(const std::filesystem::path& path, const CheckpointOwner& owner);

// For the catch around a run: `keep` puts its state on the disk, then what ended the run goes on. If it was a signal
// and the state cannot be kept, the message says so.
[[noreturn]] void keep_and_rethrow(const std::function<void()>& keep);

// OUTPUT.checkpoint beside the unfinished OUTPUT.tmp: what the checkpoints of all programs share.
class OutputCheckpoint {
 public:
  // Finds a checkpoint of `output`, if there is one; throws InputError if it belongs to another scene or version.
  OutputCheckpoint(const std::string& output, CheckpointOwner owner);

  bool found() const { return found_; }
  const std::string& path() const { return path_; }
  // Throws InputError, saying what was looked for, if none was found.
  void require() const;
  void remove() const;
  // What the processes used that made the checkpoint; zero without one.
  const Cost& used() const { return meter_.earlier(); }

 protected:
  void store(Checkpoint checkpoint) const;
  const Checkpoint& stored() const { return stored_; }

 private:
  std::string path_;
  CheckpointOwner owner_;
  bool found_;
  Checkpoint stored_;
  CostMeter meter_;
};

}  // namespace crumble
