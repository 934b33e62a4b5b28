// What both integrators share: particles and contacts that move, and the flow that moves them.
#pragma once

#include "breaker/contact_network.hpp"
#include "breaker/model.hpp"
#include "breaker/protocol.hpp"
#include "common/hydro/linear_flow.hpp"
#include "common/numerics/saved_fields.hpp"

namespace crumble::breaker {

struct IntegratorStatistics {
  std::int64_t steps = 0, rejected = 0, newton_iterations = 0, factorisations = 0, rigid_steps = 0;
  double largest_overlap = 0;  // deepest overlap of any contact at the end of a step, in the pair's radius

  void operator+=(const IntegratorStatistics& other);  // sums and the largest
  void fields(SavedFields& f);
};

// How many steps a breakup takes, before it has broken.
struct ExpectedSteps {
  double least = 0, most = 0;  // both 0: not known
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  // One step, not beyond latest_time. True if a contact was made or lost. Throws std::runtime_error saying what failed
  // where; the state is then that of the last whole step.
  virtual bool step(double latest_time) = 0;

  // rigid_strength: stress at which the agglomerate would break if it did not deform, Pa.
  virtual ExpectedSteps expected_steps(double rigid_strength) const = 0;

  // The present state in the axes of the laboratory.
  virtual Frame laboratory() const = 0;
  // The same in the axes in which the integrator works.
  const Frame& frame() const { return frame_; }
  ContactNetwork& network() { return network_; }
  const ContactNetwork& network() const { return network_; }
  const IntegratorStatistics& statistics() const { return statistics_; }

  // All that the next step depends on beside the frame, for a restart to the same bits.
  virtual void fields(SavedFields& f);

 protected:
  // The frame has positions, orientations and contacts; time 0 is the start of the protocol.
  Integrator(const BreakupModel& model, const Protocol& protocol, const std::vector<double>& radius, Frame frame);

  // Moves everything by q = (dx_i, length dtheta_i) and on to `time`; the contacts follow.
  bool move(const Eigen::VectorXd& q, double time);

  double stress(double time) const { return protocol_.stress_before(time); }
  Eigen::Matrix3d gradient_at(double time) const {
    return protocol_.has_history() ? protocol_.gradient(time) : stress(time) / model_.viscosity * model_.gradient;
  }

  const BreakupModel& model_;
  const Protocol& protocol_;
  const std::vector<double> radius_;
  const double length_;  // mean radius, m
  Frame frame_;
  ContactNetwork network_;
  IntegratorStatistics statistics_;
};

}  // namespace crumble::breaker
