#include "breaker/protocol.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace crumble {

namespace {

[[noreturn]] void refuse(const std::string& stage, const std::string& why) {
  throw std::invalid_argument("stage '" + stage + "': " + why +
                              "; stages are 'rest SECONDS', 'hold PASCALS for SECONDS', 'ramp PASCALS_PER_SECOND "
                              "[from PASCALS] [to PASCALS]', separated by ';'");
}

double number(std::istringstream& words, const std::string& stage, const char* what, bool positive) {
  double value = 0;
  if (!(words >> value) || !std::isfinite(value)) refuse(stage, std::string("needs ") + what);
  if (value < 0 || (positive && value == 0)) refuse(stage, std::string(what) + " must be positive");
  return value;
}

Stage parse_stage(const std::string& text, double stretch) {
  std::istringstream words(text);
  std::string verb, word;
  words >> verb;
  Stage stage;
  if (verb == "rest") {
    stage.duration = stretch * number(words, text, "a time in s", true);
  } else if (verb == "hold") {
    stage.stress = number(words, text, "a stress in Pa", false);
    if (!(words >> word) || word != "for") refuse(text, "needs 'for' and a time");
    stage.duration = stretch * number(words, text, "a time in s", true);
  } else if (verb == "ramp") {
    stage.rate = number(words, text, "a rate in Pa/s", true) / stretch;
    while (words >> word) {
      if (word == "from") {
        stage.stress = number(words, text, "a stress in Pa", false);
      } else if (word == "to") {
        const double end = number(words, text, "a stress in Pa", true);
        if (end <= stage.stress) refuse(text, "ends at or below the stress where it starts");
        stage.duration = (end - stage.stress) / stage.rate;
      } else {
        refuse(text, "'" + word + "' is not understood");
      }
    }
    return stage;
  } else {
    refuse(text, "starts with none of rest, hold, ramp");
  }
  if (words >> word) refuse(text, "'" + word + "' is not understood");
  return stage;
}

}  // namespace

Protocol Protocol::parse(const std::string& text, double stretch) {
  std::vector<Stage> stages;
  std::istringstream parts(text);
  std::string part;
  while (std::getline(parts, part, ';')) {
    const auto first = part.find_first_not_of(" \t\n"), last = part.find_last_not_of(" \t\n");
    if (first == std::string::npos) continue;
    if (!stages.empty() && std::isinf(stages.back().duration))
      throw std::invalid_argument("a ramp without 'to' goes on until the run ends, so nothing can follow it: '" + part +
                                  "'");
    stages.push_back(parse_stage(part.substr(first, last - first + 1), stretch));
  }
  if (stages.empty()) throw std::invalid_argument("there is no stage");
  return Protocol(std::move(stages));
}

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

double Protocol::rate(double time) const {
  double begin = 0;
  const Stage& stage = stages_[stage_at(time, begin)];
  return time < begin + stage.duration ? stage.rate : 0;
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

}  // namespace crumble
