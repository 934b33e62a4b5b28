// What only programs do: print, and choose the exit code. The rest of the library throws and returns text.
#pragma once

#include <chrono>
#include <cstdio>
#include <functional>
#include <string>

#include "common/io/progress.hpp"

namespace crumble {

// Runs the body of a main with the one catch: a failure is printed to stderr as one message, and becomes the exit code
// (0 done, 1 failed, 2 input, 3 file format, 128 + signal). Also starts watching for SIGINT and SIGTERM, and makes
// closed streams, limits on files and small stacks harmless.
int run_program(const std::string& name, const std::function<int()>& body);

// The end of a run whose file is written: its report, and its answer on stdout. Each is given although the other fails.
void deliver(
    const std::string& answer, const std::function<void()>& write_report = [] {});

// One line per report interval, on a terminal one live line instead; nothing when quiet.
class ProgressPrinter {
 public:
  ProgressPrinter(std::FILE* out, std::string label, bool quiet);
  ~ProgressPrinter();
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  // Call as often as you like; `status` is asked for only when a line is due.
  void update(double fraction, std::int64_t steps, const std::function<std::string()>& status);
  // Prints a line of its own, above the live line if there is one.
  void say(const std::string& message);

 private:
  void clear();
  std::FILE* out_;
  Progress progress_;
  bool quiet_, live_, on_screen_ = false;
  std::chrono::steady_clock::time_point begin_, due_;
};

}  // namespace crumble
