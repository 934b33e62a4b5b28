// Histories of the velocity gradient.
#include "common/flow/gradient_history.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tests/fuzz/harness.hpp"

namespace crumble::fuzz {

std::string history(std::string_view text) {
  return outcome([&] {
    const GradientHistory history = GradientHistory::parse(std::string(text), "history.csv");
    const double first = history.times().front(), last = history.times().back();
    for (const double time : {first, 0.5 * first + 0.5 * last, last})
      if (!history(time).allFinite()) throw Finding("a gradient is no number");
    if (!std::isfinite(history.largest_rate()) || !std::isfinite(history.mean_square_rate()))
      throw Finding("a rate is no number");
    return fmt::format("{} instants, at most {:g} 1/s", history.times().size(), history.largest_rate());
  });
}

}  // namespace crumble::fuzz
