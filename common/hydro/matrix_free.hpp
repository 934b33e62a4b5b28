// Hydrodynamics of clusters that are too large for a dense factor: memory of order N, time of order N^2 an iteration.
#pragma once

#include <functional>
#include <memory>

#include "common/hydro/iterative_hydrodynamics.hpp"
#include "common/hydro/sparse_inverse.hpp"

namespace crumble {

struct MatrixFreeSettings {
  double tolerance = 1e-8;  // resistance: of the residual, relative; mobility: of the velocities
  int limit = 500;          // iterations
  int neighbours = 30;      // resistance: what a sphere keeps in the preconditioner; 0 leaves its own mobility
  std::function<void(int column, int columns, int iterations)> on_solved = {};  // of every solved right-hand side
};

//   resistance  conjugate gradients, preconditioned by SparseInverse
//   mobility    GMRES, preconditioned by the sparse near field: every sphere's own drag and the lubrication of its
//   pairs
//               (CHOLMOD, METIS ordering)
class MatrixFreeHydrodynamics : public IterativeHydrodynamics {
 public:
  // Throws std::invalid_argument for multipoles; solves throw std::runtime_error if they do not converge.
  MatrixFreeHydrodynamics(const Spheres& spheres, double viscosity, const HydroModel& model,
                          const MatrixFreeSettings& settings = {});
  ~MatrixFreeHydrodynamics() override;

  // Of the last call, over all its right-hand sides: the most that one needed.
  int iterations() const { return most_iterations_; }

 protected:
  Eigen::VectorXd solve_far_field(const Operator& mobility, const Eigen::VectorXd& w) const override;
  Eigen::VectorXd solve_saddle(const Operator& saddle, const Eigen::VectorXd& b) const override;
  void solved(Eigen::Index column, Eigen::Index columns) const override;

 private:
  struct NearField;
  MatrixFreeSettings settings_;
  // Made when first asked for.
  mutable std::unique_ptr<SparseInverse> inverse_;
  mutable std::unique_ptr<NearField> near_;
  mutable int iterations_ = 0, most_iterations_ = 0;
};

}  // namespace crumble
