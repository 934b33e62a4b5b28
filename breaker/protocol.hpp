// How strong the flow is at which time: a sequence of stages, or a history of its gradient.
#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "common/flow/gradient_history.hpp"

namespace crumble::breaker {

// One stage: the flow stress mu gamma_dot (Pa) starts at `stress` and changes at `rate` (Pa/s) for `duration` (s).
struct Stage {
  double stress = 0, rate = 0, duration = std::numeric_limits<double>::infinity();
};

class Protocol {
 public:
  Protocol() = default;
  explicit Protocol(std::vector<Stage> stages) : stages_(std::move(stages)) {}

  // The flow stress is the viscosity (Pa s) times the rate of the history, of which time 0 is the first instant.
  Protocol(std::shared_ptr<const GradientHistory> history, double viscosity)
      : history_(std::move(history)), viscosity_(viscosity) {}

  bool has_history() const { return history_ != nullptr; }
  const GradientHistory& history() const { return *history_; }
  Eigen::Matrix3d gradient(double time) const { return (*history_)(history_->times().front() + time); }  // 1/s
  double largest_stress(double time) const;  // Pa, of the history up to a time
  std::vector<double> corners(double tolerance, double weak_stress) const;  // s; of the history, else none

  double stress(double time) const;         // Pa, at a boundary that of the later stage
  double stress_before(double time) const;  // at a boundary that of the earlier stage
  double stage_end(double time) const;      // s, of the stage that holds just after `time`; infinite for the last ramp
  double end() const;                       // s
  double time_of(double stress) const;  // s, when a ramp (a row of the history) first reaches it; infinite if none does
  // Strain gamma_dot dt summed up to a time: integral of stress over viscosity, for 1 Pa s.
  double strain(double time) const;
  const std::vector<Stage>& stages() const { return stages_; }

 private:
  std::vector<Stage> stages_;
  std::shared_ptr<const GradientHistory> history_;
  double viscosity_ = 0;

  std::size_t stage_at(double time, double& begin) const;
};

}  // namespace crumble::breaker
