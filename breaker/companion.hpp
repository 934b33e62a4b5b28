// The same breakup with other control: its difference is the error of the run.
#pragma once

#include <atomic>
#include <exception>
#include <limits>
#include <thread>

#include "breaker/run.hpp"

namespace crumble::breaker {

// Runs beside the main run in a thread of its own, or when asked for the result.
class Companion {
 public:
  Companion(const BreakerScene& scene, const Agglomerate& start, bool beside);
  ~Companion();
  Companion(const Companion&) = delete;
  Companion& operator=(const Companion&) = delete;

  bool done() const { return done_; }
  // Waits. Critical stress, Pa; infinite where nothing broke. Stops with Interrupted at a signal.
  double critical_stress();

 private:
  BreakerScene scene_;
  const Agglomerate& start_;
  std::thread thread_;
  std::atomic<bool> done_ = false, stop_ = false;
  double result_ = std::numeric_limits<double>::infinity();
  std::exception_ptr failure_;

  void run();
};

}  // namespace crumble::breaker
