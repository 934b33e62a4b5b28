#include "breaker/protocol.hpp"

#include <algorithm>

namespace crumble::breaker {

std::size_t Protocol::stage_at(double time, double& begin) const {
  begin = 0;
  std::size_t k = 0;
  while (k + 1 < stages_.size() && time >= begin + stages_[k].duration) begin += stages_[k++].duration;
  return k;
}

std::vector<double> Protocol::corners(double tolerance, double weak_stress) const {
  if (!has_history()) return {};
  std::vector<double> found = history_->corners(tolerance, weak_stress / viscosity_);
  for (double& t : found) t -= history_->times().front();
  return found;
}

double Protocol::largest_stress(double time) const {
  double largest = stress(time);
  const std::vector<double>& times = history_->times();
  for (std::size_t k = 0; k < times.size() && times[k] - times.front() <= time; ++k)
    largest = std::max(largest, viscosity_ * rate_of(history_->at(k)));
  return largest;
}

double Protocol::stress(double time) const {
  if (has_history()) return viscosity_ * rate_of(gradient(time));
  double begin = 0;
  const Stage& stage = stages_[stage_at(time, begin)];
  return stage.stress + stage.rate * std::min(time - begin, stage.duration);
}

double Protocol::stress_before(double time) const {
  if (has_history()) return stress(time);
  double begin = 0;
  std::size_t k = 0;
  while (k + 1 < stages_.size() && time > begin + stages_[k].duration) begin += stages_[k++].duration;
  return stages_[k].stress + stages_[k].rate * std::min(time - begin, stages_[k].duration);
}

double Protocol::stage_end(double time) const {
  if (has_history()) return end();
  double begin = 0;
  const Stage& stage = stages_[stage_at(time, begin)];
  return begin + stage.duration;
}

double Protocol::end() const {
  if (has_history()) return history_->times().back() - history_->times().front();
  double sum = 0;
  for (const Stage& stage : stages_) sum += stage.duration;
  return sum;
}

double Protocol::time_of(double stress) const {
  if (has_history()) {
    const std::vector<double>& times = history_->times();
    for (std::size_t k = 0; k < times.size(); ++k)
      if (viscosity_ * rate_of(history_->at(k)) >= stress) return times[k] - times.front();
    return std::numeric_limits<double>::infinity();
  }
  double begin = 0;
  for (const Stage& stage : stages_) {
    if (stage.rate > 0 && stage.stress + stage.rate * stage.duration >= stress)
      return begin + std::max(stress - stage.stress, 0.0) / stage.rate;
    begin += stage.duration;
  }
  return std::numeric_limits<double>::infinity();
}

double Protocol::strain(double time) const {
  if (has_history()) {
    const std::vector<double>& times = history_->times();
    double sum = 0;
    for (std::size_t k = 1; k < times.size() && times[k - 1] - times.front() < time; ++k) {
      const double from = times[k - 1] - times.front(), to = std::min(times[k] - times.front(), time);
      // Simpson's rule: the rate of a gradient that changes evenly is no straight line.
      sum += (to - from) / 6 * (stress(from) + 4 * stress(0.5 * (from + to)) + stress(to));
    }
    return sum;
  }
  double sum = 0, begin = 0;
  for (const Stage& stage : stages_) {
    const double t = std::clamp(time - begin, 0.0, stage.duration);
    sum += t * (stage.stress + 0.5 * stage.rate * t);
    begin += stage.duration;
    if (time <= begin) break;
  }
  return sum;
}

}  // namespace crumble::breaker
