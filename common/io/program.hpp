// What only programs do: print, and choose the exit code. The rest of the library throws and returns text.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "common/io/progress.hpp"

namespace crumble {

// Runs the body of a main with the one catch: a failure is printed to stderr as one message, and becomes the exit code
// (0 done, 1 failed, 2 input, 3 file format, 128 + signal). Also starts watching for SIGINT and SIGTERM, and makes
// closed streams, limits on files and small stacks harmless.
int run_program(const std::string& name, const std::function<int()>& body);

// The end of a run whose file is written: its report, and its answer on stdout. Each is given although the other fails.
void deliver(
    const std::string& answer, const std::function<void()>& write_report = [] {});

// One line per report interval, on a terminal one live line instead; nothing when quiet. Where nothing is heard for
// seconds, a thread says what is in hand and for how long.
class ProgressPrinter {
 public:
  ProgressPrinter(std::FILE* out, std::string label, bool quiet);
  ~ProgressPrinter();
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  // Call as often as you like; `status` is asked for only when a line is due.
  void update(double fraction, std::int64_t steps, const std::function<std::string()>& status,
              const std::optional<StepRange>& all = std::nullopt);
  // Another run is reported from now on.
  void begin(std::string label);
  // What takes its time from now on: "filling the droplet".
  void in_hand(const std::string& what);
  // Prints a line of its own, above the live line if there is one.
  void say(const std::string& message);

 private:
  using Clock = std::chrono::steady_clock;
  void clear();
  void print(const std::string& line);
  void beat(const std::stop_token& stop);

  std::FILE* out_;
  std::string label_, last_line_, hand_ = "getting ready";
  Progress progress_;
  bool quiet_, live_, on_screen_ = false;
  Clock::time_point begin_, due_, last_, heard_;  // last printed, last heard of
  std::mutex mutex_;
  std::condition_variable_any woken_;
  std::jthread heart_;
};

}  // namespace crumble
