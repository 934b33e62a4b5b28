// How strong the flow is at which time: a sequence of stages.
#pragma once

#include <limits>
#include <utility>
#include <vector>

namespace crumble::breaker {

// One stage: the flow stress mu gamma_dot (Pa) starts at `stress` and changes at `rate` (Pa/s) for `duration` (s).
struct Stage {
  double stress = 0, rate = 0, duration = std::numeric_limits<double>::infinity();
};

class Protocol {
 public:
  Protocol() = default;
  explicit Protocol(std::vector<Stage> stages) : stages_(std::move(stages)) {}

  double stress(double time) const;         // Pa, at a boundary that of the later stage
  double stress_before(double time) const;  // at a boundary that of the earlier stage
  double stage_end(double time) const;      // s, of the stage that holds just after `time`; infinite for the last ramp
  double end() const;                       // s
  double time_of(double stress) const;      // s, when a ramp first reaches it; infinite if none does
  // Strain gamma_dot dt summed up to a time: integral of stress over viscosity, for 1 Pa s.
  double strain(double time) const;
  const std::vector<Stage>& stages() const { return stages_; }

 private:
  std::vector<Stage> stages_;
  std::size_t stage_at(double time, double& begin) const;
};

}  // namespace crumble::breaker
