#include "common/io/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crumble {

std::string duration_text(double seconds) {
  if (!(seconds < 1e9)) return "unknown time";
  if (seconds < 9.95) return fmt::format("{:.1f} s", std::max(seconds, 0.0));
  const auto s = std::llround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  if (s < 86400) return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
  return fmt::format("{} d {} h", s / 86400, s % 86400 / 3600);
}

std::string duration_range(double low, double high) {
  const auto in = [&](double unit, const char* name) {
    return fmt::format("{:.2g} to {:.2g} {}", low / unit, high / unit, name);
  };
  if (high < 90) return in(1, "s");
  if (high < 5400) return in(60, "min");
  if (high < 2 * 86400) return in(3600, "h");
  return in(86400, "days");
}

namespace {

// Of the steps that are left, at the speed of the last ones.
std::string left(const StepRange& all, double done, double seconds_a_step) {
  if (done > all.most) return ", longer than expected";
  const double low = std::max(all.least - done, 0.0) * seconds_a_step, high = (all.most - done) * seconds_a_step;
  return ", " + (low > 0 ? duration_range(low, high) : "up to " + duration_text(high)) + " left";
}

}  // namespace

std::string Progress::line(double now, double fraction, std::int64_t steps, const std::string& status,
                           const std::optional<StepRange>& all) {
  constexpr std::size_t memory = 8;  // reports
  std::string out = fmt::format("{}: {:3.0f} %", label_, 100 * std::clamp(fraction, 0.0, 1.0));
  if (!marks_.empty() && steps < marks_.back().steps) marks_.clear();
  if (!marks_.empty()) {
    const Mark& old = marks_.front();
    const double seconds = now - old.time, gained = fraction - old.fraction;
    if (seconds > 0) out += fmt::format(", {:.2g} steps/s", static_cast<double>(steps - old.steps) / seconds);
    if (all && seconds > 0 && steps > old.steps)
      out += left(*all, static_cast<double>(steps), seconds / static_cast<double>(steps - old.steps));
    else if (seconds > 0 && gained > 0)
      out += ", " + duration_text((1 - fraction) * seconds / gained) + " left";
  }
  marks_.push_back({now, fraction, steps});
  if (marks_.size() > memory) marks_.pop_front();
  return status.empty() ? out : out + ", " + status;
}

}  // namespace crumble
