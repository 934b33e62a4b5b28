// SIGINT (Ctrl-C) and SIGTERM ask a run to save its state and stop. Those that come within a second are one request: a
// scheduler and the command that it runs may both send one. A later one ends it at once.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace crumble {

// From the first signal on a program has half a second to come to a place where it asks for it, and to leave. After
// that, deep in whatever library it may be, the process is ended: a thread that only waits for this does what
// AtSuddenEnd asks for, says what is kept, and exits with 128 + signal.
void watch_for_interrupts(const std::string& program = "");

// The body of the program is over: nothing ends it suddenly any more.
void end_watch() noexcept;

// The signal that has come since `watch_for_interrupts`, or 0. Cheap enough for every step of a run.
int interrupt_signal() noexcept;

// While it lives, done before a sudden end, in another thread than its maker's. What it returns is said.
class AtSuddenEnd {
 public:
  explicit AtSuddenEnd(std::function<std::string()> action);
  ~AtSuddenEnd();
  AtSuddenEnd(const AtSuddenEnd&) = delete;
  AtSuddenEnd& operator=(const AtSuddenEnd&) = delete;
};

// While it lives, a file that is then removed: one that is worth nothing without its run.
class RemovedAtSuddenEnd {
 public:
  explicit RemovedAtSuddenEnd(std::filesystem::path file);
  ~RemovedAtSuddenEnd();
  RemovedAtSuddenEnd(const RemovedAtSuddenEnd&) = delete;
  RemovedAtSuddenEnd& operator=(const RemovedAtSuddenEnd&) = delete;
};

}  // namespace crumble
