// The exact state of a run that is not over, private to the program that wrote it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "common/io/cost.hpp"
#include "common/numerics/saved_fields.hpp"

namespace crumble {

// Who may continue: the same program, version and resolved scene.
struct CheckpointOwner {
  std::string program, version, scene;  // scene: the resolved text
};

// The arrays of the state stored to the bit, with a SHA-256 of all of the file. Written under a temporary name, put on
// the disk and renamed: there is always one whole checkpoint or none.
void save_checkpoint(const std::filesystem::path& path, const CheckpointOwner& owner, const SavedState& state);

// Throws InputError saying which of program, version and scene differs and what to do, ContentError if the file is not
// a checkpoint, or not as it was written.
SavedState load_checkpoint(const std::filesystem::path& path, const CheckpointOwner& owner);

// OUTPUT.checkpoint: what the checkpoints of all programs share.
class OutputCheckpoint {
 public:
  // Finds a checkpoint of `output`, if there is one; throws InputError if it belongs to another scene or version.
  OutputCheckpoint(const std::string& output, CheckpointOwner owner);

  bool found() const { return found_; }
  const std::string& path() const { return path_; }
  // What a run that was killed has left beside the output and is of no use, in words; it is removed.
  std::string leftovers() const;
  // Throws InputError, saying what was looked for, if none was found.
  void require() const;
  void remove() const;
  // What the processes used that made the checkpoint; zero without one.
  const Cost& used() const { return meter_.earlier(); }

  // What `visit` lists, and what was used so far.
  SavedState collect(const std::function<void(SavedFields&)>& visit) const;
  void write(const SavedState& state) const;
  // The answer of `use` to the stored fields; throws InputError naming the field that is missing or not known.
  template <class Use>
  auto restored(Use use) const {
    try {
      SavedFields f = SavedFields::loader(stored_);
      return use(f);
    } catch (const SavedFieldError& error) {
      refuse(error.what());
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const;

  std::string output_, path_;
  CheckpointOwner owner_;
  bool found_;
  SavedState stored_;
  CostMeter meter_;
};

}  // namespace crumble
