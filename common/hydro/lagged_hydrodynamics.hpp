// Hydrodynamics of a configuration that moves little between solves: exact for the present positions, with the factor
// of an earlier configuration as preconditioner.
#pragma once

#include <variant>

#include "common/hydro/constrained_factor.hpp"
#include "common/hydro/iterative_hydrodynamics.hpp"

namespace crumble {

// Flexible GMRES: each iteration costs one product with M, one with the sparse D, and the triangular solves of the
// lagged factor, which is renewed when a solve needs more than `refresh_after` iterations.
struct LaggedSettings {
  double tolerance = 1e-8;       // relative error of a solve
  int refresh_after = 8;         // iterations
  bool single_precision = true;  // of the factor; solutions are float64 in any case
};

class LaggedHydrodynamics : public IterativeHydrodynamics {
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
  // Where the spheres were when the preconditioner was made, m. An object that is constructed there and then updated
  // to the present positions goes on to the same bits.
  const std::vector<Vector3>& factored_at() const { return factored_at_; }
  Work work() const { return {iterations_, products(), factorisations_}; }

 protected:
  Eigen::VectorXd solve_far_field(const Operator& mobility, const Eigen::VectorXd& w) const override;
  Eigen::VectorXd solve_saddle(const Operator& saddle, const Eigen::VectorXd& b) const override;

 private:
  LaggedSettings settings_;
  std::vector<Vector3> position_;
  mutable std::vector<Vector3> factored_at_;
  // Renewing the preconditioner and counting work do not change what the operator is.
  mutable std::variant<std::monostate, ConstrainedFactor<float>, ConstrainedFactor<double>> factor_;
  mutable int iterations_ = 0, factorisations_ = 0;

  void refresh() const;
  template <class Solve>
  Eigen::VectorXd with_factor(const Eigen::VectorXd& r, const Solve& solve) const;
  Eigen::VectorXd solve(const Operator& apply, const Operator& precondition, const Eigen::VectorXd& b) const;
};

}  // namespace crumble
