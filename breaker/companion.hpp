// The same breakup with other control: its difference is the error of the run.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>

#include "breaker/run.hpp"

namespace crumble::breaker {

// Runs beside the main run in a thread of its own, or when asked for the result.
class Companion {
 public:
  // saved: the state from which it goes on, empty at its beginning.
  Companion(const BreakerScene& scene, const Agglomerate& start, bool beside, SavedState saved);
  ~Companion();
  Companion(const Companion&) = delete;
  Companion& operator=(const Companion&) = delete;

  // The state after the step in which it is, or after an earlier one if that takes longer than a moment.
  SavedState state();

  // Waits. Measure of the breakup: critical stress, Pa, or its time along a history, s; infinite where nothing broke.
  // `between_steps` is called now and then meanwhile, and may throw.
  double outcome(const std::function<void()>& between_steps);

 private:
  BreakerScene scene_;
  const Agglomerate& start_;
  std::optional<BreakupRun> run_;
  std::thread thread_;
  std::atomic<bool> over_ = false, stop_ = false, wanted_ = false;
  std::mutex mutex_;
  SavedState state_;
  std::exception_ptr failure_;

  void begin();
  void run();
  void publish();
};

}  // namespace crumble::breaker
