#include "breaker/protocol.hpp"

#include <algorithm>

namespace crumble::breaker {

std::size_t Protocol::stage_at(double time, double& begin) const {
  begin = 0;
  std::size_t k = 0;
  while (k + 1 < stages_.size() && time >= begin + stages_[k].duration) begin += stages_[k++].duration;
  return k;
}

double Protocol::stress(double time) const {
  double begin = 0;
  const Stage& stage = stages_[stage_at(time, begin)];
  return stage.stress + stage.rate * std::min(time - begin, stage.duration);
}

double Protocol::stress_before(double time) const {
  double begin = 0;
  std::size_t k = 0;
  while (k + 1 < stages_.size() && time > begin + stages_[k].duration) begin += stages_[k++].duration;
  return stages_[k].stress + stages_[k].rate * std::min(time - begin, stages_[k].duration);
}

double Protocol::stage_end(double time) const {
  double begin = 0;
  const Stage& stage = stages_[stage_at(time, begin)];
  return begin + stage.duration;
}

double Protocol::end() const {
  double sum = 0;
  for (const Stage& stage : stages_) sum += stage.duration;
  return sum;
}

double Protocol::time_of(double stress) const {
  double begin = 0;
  for (const Stage& stage : stages_) {
    if (stage.rate > 0 && stage.stress + stage.rate * stage.duration >= stress)
      return begin + std::max(stress - stage.stress, 0.0) / stage.rate;
    begin += stage.duration;
  }
  return std::numeric_limits<double>::infinity();
}

double Protocol::strain(double time) const {
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
