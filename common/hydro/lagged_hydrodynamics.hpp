// Hydrodynamics of a configuration that moves little between solves: exact for the present positions, with the factor
// of an earlier configuration as preconditioner.
#pragma once

#include <optional>
#include <variant>

#include "common/hydro/constrained_factor.hpp"
#include "common/hydro/far_field_sum.hpp"
#include "common/hydro/hydrodynamics.hpp"
#include "common/hydro/model.hpp"

namespace crumble {

// The mobility problem in far-field loads f (saddle form, no inverse of M): with velocities u = M f,
//   (M f)_strain = -E,   f_motion + (D u)_motion = known loads - D of the ambient strain,
// so that each iteration costs one product with M, summed over pairs without a matrix, one with the sparse D, and the
// triangular solves of the lagged factor. The factor is renewed when a solve needs more than `refresh_after`
// iterations.
struct LaggedSettings {
  double tolerance = 1e-8;       // relative error of a solve
  int refresh_after = 8;         // iterations
  bool single_precision = true;  // of the factor; solutions are float64 in any case
};

class LaggedHydrodynamics : public Hydrodynamics {
 public:
  // Far-field rungs only: std::invalid_argument for multipoles.
  LaggedHydrodynamics(const Spheres& spheres, double viscosity, const HydroModel& model,
                      const LaggedSettings& settings = {});

  // Present positions, m.
  void update(const std::vector<Vector3>& position);

  struct Work {
    int iterations = 0;      // of the last solve
    long products = 0;       // with M, since construction
    int factorisations = 0;  // since construction
  };
  const Work& work() const { return work_; }

 protected:
  void solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& q_motion,
                        Eigen::MatrixXd& q_strain) const override;
  void solve_mobility(const Eigen::MatrixXd& q_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& w_motion,
                      Eigen::MatrixXd& q_strain) const override;

 private:
  HydroModel model_;
  LaggedSettings settings_;
  Lubrication lubrication_;
  std::optional<FarFieldSum> far_field_;
  // Renewing the preconditioner and counting work do not change what the operator is.
  mutable std::variant<std::monostate, ConstrainedFactor<float>, ConstrainedFactor<double>> factor_;
  mutable Work work_;

  void refresh() const;
  Eigen::VectorXd product(const Eigen::VectorXd& f) const;
  template <class Solve>
  Eigen::VectorXd with_factor(const Eigen::VectorXd& r, const Solve& solve) const;
  Eigen::VectorXd precondition_mobility(const Eigen::VectorXd& r) const;
  Eigen::VectorXd precondition_resistance(const Eigen::VectorXd& r) const;
  template <class Apply, class Precondition>
  Eigen::VectorXd solve(const Apply& apply, const Precondition& precondition, const Eigen::VectorXd& b) const;
};

}  // namespace crumble
