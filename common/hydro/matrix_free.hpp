// Hydrodynamics of clusters that are too large for a dense factor: memory of order N, time of order N^2 an iteration.
#pragma once

#include <functional>
#include <memory>

#include "common/hydro/far_field_sum.hpp"
#include "common/hydro/hydrodynamics.hpp"
#include "common/hydro/model.hpp"
#include "common/hydro/sparse_inverse.hpp"

namespace crumble {

struct MatrixFreeSettings {
  double tolerance = 1e-8;  // resistance: of the residual, relative; mobility: of the velocities
  int limit = 500;          // iterations
  int neighbours = 30;      // resistance: what a sphere keeps in the preconditioner; 0 leaves its own mobility
  std::function<void(int column, int columns, int iterations)> heard = {};  // of every solved right-hand side
};

// Far-field rungs of the ladder.
//   resistance  conjugate gradients on M f = w, the product summed over pairs, preconditioned by SparseInverse; then
//   the
//               pair lubrication of the given motion
//   mobility    the saddle form of LaggedHydrodynamics by GMRES, preconditioned by the sparse near field: every
//   sphere's
//               own drag and the lubrication of its pairs (CHOLMOD, METIS ordering)
class MatrixFreeHydrodynamics : public Hydrodynamics {
 public:
  // Throws std::invalid_argument for multipoles; solves throw std::runtime_error if they do not converge.
  MatrixFreeHydrodynamics(const Spheres& spheres, double viscosity, const HydroModel& model,
                          const MatrixFreeSettings& settings = {});
  ~MatrixFreeHydrodynamics() override;

  // Of the last call, over all its right-hand sides: the most that one needed.
  int iterations() const { return iterations_; }

 protected:
  void solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& q_motion,
                        Eigen::MatrixXd& q_strain) const override;
  void solve_mobility(const Eigen::MatrixXd& q_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& w_motion,
                      Eigen::MatrixXd& q_strain) const override;

 private:
  struct NearField;
  MatrixFreeSettings settings_;
  FarFieldSum sum_;
  Lubrication lubrication_;
  // Made when first asked for.
  mutable std::unique_ptr<SparseInverse> inverse_;
  mutable std::unique_ptr<NearField> near_;
  mutable int iterations_ = 0;

  Eigen::VectorXd product(const Eigen::VectorXd& f) const;
  Eigen::VectorXd conjugate_gradients(const Eigen::VectorXd& w) const;
  void heard(Eigen::Index column, Eigen::Index columns, int iterations) const;
};

}  // namespace crumble
