// The paper's own integrator: Newton's equations with inertia, fixed step, second order. Slow; the reference for all
// else.
#pragma once

#include "common/numerics/noise.hpp"
#include "dryer/integrator.hpp"
#include "dryer/surface_pairs.hpp"
#include "dryer/work.hpp"

namespace crumble::dryer {

//   m dv/dt = sum of all forces,   I dW/dt = sum of all torques                           (paper, Eq. 1)
// One step is a symmetric splitting: half a kick, a drift, half a kick. In a kick the force is constant and
// the drag exact: v <- v e + (F/zeta)(1 - e), e = exp(-zeta dt/(2 m)); rotations likewise with zeta_r and I = (2/5) m
// a^2. Bond histories are advanced over the drift. Second order in dt for smooth forces (test), stable for dt <
// 2/omega_max.
class Inertial : public Integrator {
 public:
  static constexpr std::string_view summary = "Newton's equations with inertia: a fixed step, for comparison only";

  // seed: of the Brownian forces; of no matter while model.thermal_energy is 0.
  Inertial(const DryingModel& model, Agglomerate& state, double step, std::uint64_t seed = 0);

  // Throws std::domain_error naming the particle if a velocity is no longer finite (step too large).
  void step(double latest_time) override;
  std::optional<double> ionic_strength() const override;

  // 0.2 sqrt(m/k), k the stiffest spring of the smallest particle: a fifth of the period of a bonded pair / 2 pi.
  // With surface forces also of the stiffest gap of theirs, at the start.
  static double recommended_step(const DryingModel& model, const Particles& particles);

  // The fixed step, for all particles from the beginning to the end.
  static Work expected_work(const DryingModel& model, const std::vector<double>& radius, double step,
                            const StepTimes& times);

 private:
  void kick();
  void drift();
  void evaluate_forces();
  void check_finite() const;

  Vector3 random_vector(Purpose purpose, std::int32_t particle) const;

  double step_;
  std::uint64_t seed_;
  bool forces_known_ = false;
  struct HalfKick {
    double kept, gained, kept_rotation, gained_rotation;
  };
  std::vector<HalfKick> kicks_;  // per particle
  std::optional<SurfacePairs> surface_pairs_;
};

}  // namespace crumble::dryer
