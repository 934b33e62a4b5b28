// What keeps the work of a run: the one place where the programs ask for a signal, and save their state now and then.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "common/io/checkpoint.hpp"
#include "common/io/frame_log.hpp"
#include "common/io/interrupt.hpp"

namespace crumble {

// Two copies of the state are kept. One is on the disk, saved every `interval` of wall time. One is in memory, no older
// than some hundredths of a second, unless the state is large: it goes to the disk when a signal comes and the step in
// hand does not end. Neither is made so often that it takes more than a part in two hundred of the time; and neither
// changes anything in the run.
class StateKeeper {
 public:
  using Say = std::function<void(const std::string&)>;

  // interval, s; 0: the disk has the state only when the run ends early. `fields` lists the state as it is between two
  // steps; frames: what was written so far, if the run writes as it goes.
  StateKeeper(const OutputCheckpoint& checkpoint, double interval, std::function<void(SavedFields&)> fields,
              FrameLog* frames, Say say);

  // To be called wherever the state is whole. Throws Interrupted, "stopped " and where, if a signal has come.
  void between_steps(const std::function<std::string()>& where);
  void save();

  // Does `work`. What ends it early goes on, with the state saved: that of now after a signal or a full disk, else the
  // last whole one.
  template <class Work>
  void guard(Work work) {
    try {
      work();
    } catch (const std::exception& error) {
      keep_and_rethrow(error);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  SavedState collect();
  void write(const SavedState& state);
  void remember();
  std::string save_the_remembered();
  std::string kept() const;
  [[noreturn]] void keep_and_rethrow(const std::exception& error);

  const OutputCheckpoint& checkpoint_;
  double interval_;
  std::function<void(SavedFields&)> fields_;
  FrameLog* frames_;
  Say say_;
  std::mutex writing_;
  std::shared_ptr<const SavedState> remembered_;  // not yet on the disk
  bool on_disk_, small_ = true, ended_ = false;
  Clock::time_point disk_due_, memory_due_;
  AtSuddenEnd at_sudden_end_;
};

}  // namespace crumble
