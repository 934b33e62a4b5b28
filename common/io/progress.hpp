// How far a run has come, in words; who prints them is the program's affair (program.hpp).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace crumble {

// "90 s" as "1 min 30 s"; two units at most.
std::string duration_text(double seconds);

// "2 to 4 s": both ends in one unit, that of the upper.
std::string duration_range(double low, double high);

// How many steps a run will take, where no share of the work is known on the way.
struct StepRange {
  double least = 0, most = 0;
};

// Knows the last few reports, and takes speed and time left from them: a run is rarely equally fast all the way.
class Progress {
 public:
  explicit Progress(std::string label) : label_(std::move(label)) {}

  // "hollow-1:  42 %, 1.3e+04 steps/s, 12 s left, R = 150 nm". Times in s on any clock that does not go back; the first
  // call sets the start, and so does one with fewer steps than the last: a run that begins anew.
  // With a range of steps the time left is a range, too, which shrinks from step to step: "5 to 40 s left".
  std::string line(double now, double fraction, std::int64_t steps, const std::string& status,
                   const std::optional<StepRange>& all = std::nullopt);

 private:
  struct Mark {
    double time, fraction;
    std::int64_t steps;
  };
  std::string label_;
  std::deque<Mark> marks_;
};

}  // namespace crumble
