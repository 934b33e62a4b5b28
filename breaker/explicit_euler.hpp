// The paper's integrator: first order, explicit, fixed step. Slow, kept as the reference of the fast one.
#pragma once

#include <memory>
#include <string_view>

#include "breaker/integrator.hpp"
#include "common/hydro/lagged_hydrodynamics.hpp"

namespace crumble::breaker {

// Velocities from the mobility problem of the present positions in the axes of the laboratory: independent of the
// frame, the matrices and the solver of the implicit integrator.
class ExplicitEuler : public Integrator {
 public:
  static constexpr std::string_view summary =
      "the paper's explicit method of first order: a fixed step, for comparison only";

  // step: s; 0 takes half of the stability limit; `coarsening` multiplies either. Throws std::invalid_argument for a
  // step beyond the limit unless `allow_unstable`.
  ExplicitEuler(const BreakupModel& model, const Protocol& protocol, const std::vector<double>& radius, Frame frame,
                double step, bool allow_unstable = false, double coarsening = 1);

  bool step(double latest_time) override;
  Frame laboratory() const override { return frame_; }
  // Fixed steps until the ramp is at half the rigid strength, or at twice.
  ExpectedSteps expected_steps(double rigid_strength) const override;

  void fields(SavedFields& f) override;

 private:
  double dt_ = 0, limit_ = 0;
  std::unique_ptr<LaggedHydrodynamics> hydrodynamics_;
  Eigen::VectorXd loads_, increment_;

  void renew(const std::vector<Vector3>& position);
  // 2/lambda_max of the mobility times the elastic stiffness of the contacts at the start, by power iteration, s.
  double measured_limit();
};

}  // namespace crumble::breaker
