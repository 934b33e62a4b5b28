// Far-field hydrodynamics of a rigid agglomerate that is too large for a dense factor.
#pragma once

#include <functional>

#include "common/hydro/far_field_sum.hpp"
#include "common/hydro/hydrodynamics.hpp"

namespace crumble {

// Loads of spheres in given motion by conjugate gradients on the mobility, M q = w, whose product is summed over pairs
// without a matrix. M is symmetric positive definite and without lubrication well conditioned (its extreme eigenvalues
// are those of a translation of the whole and of a stresslet of one sphere), so the diagonal preconditions well enough.
// Memory of order N; time of order N^2 an iteration.
class MatrixFreeFarField : public Hydrodynamics {
 public:
  // tolerance: of the residual of w, relative. `heard` is told of each solved column and its iterations.
  MatrixFreeFarField(const Spheres& spheres, double viscosity, double tolerance,
                     std::function<void(int column, int columns, int iterations)> heard = {});

 protected:
  void solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& q_motion,
                        Eigen::MatrixXd& q_strain) const override;
  // A rigid body asks for loads only: std::logic_error.
  void solve_mobility(const Eigen::MatrixXd& q_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& w_motion,
                      Eigen::MatrixXd& q_strain) const override;

 private:
  FarFieldSum sum_;
  double tolerance_;
  std::function<void(int, int, int)> heard_;
  Eigen::VectorXd inverse_diagonal_;

  Eigen::VectorXd solve(const Eigen::VectorXd& w, int& iterations) const;
};

}  // namespace crumble
