// What can go wrong for the user, told apart by the exit code that a program ends with.
#pragma once

#include <stdexcept>
#include <string>

namespace crumble {

// The scene or the command line is wrong: exit code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A data file is not what its format says: exit code 3.
struct FormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// SIGINT or SIGTERM ended the run, the state is saved: exit code 128 + signal.
struct Interrupted : std::runtime_error {
  explicit Interrupted(int signal_number, const std::string& what = "stopped by a signal")
      : std::runtime_error(what), signal(signal_number) {}
  int signal;
};

}  // namespace crumble
