// Hydrodynamics of one fixed configuration by a Cholesky factor of its whole mobility matrix.
#pragma once

#include "common/hydro/constrained_factor.hpp"
#include "common/hydro/hydrodynamics.hpp"
#include "common/hydro/model.hpp"

namespace crumble {

// Cost: assembly ~ N^2, factor ~ (n N)^3/3 with n = 11 (fts and lubrication) or 3 (L + 1)^2 - 1 (multipole) unknowns a
// sphere, memory 8 (n N)^2 bytes twice. Then every right-hand side costs a few (n N)^2.
class DenseHydrodynamics : public Hydrodynamics {
 public:
  DenseHydrodynamics(const Spheres& spheres, double viscosity, const HydroModel& model);

 protected:
  void solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& q_motion,
                        Eigen::MatrixXd& q_strain) const override;
  void solve_mobility(const Eigen::MatrixXd& q_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& w_motion,
                      Eigen::MatrixXd& q_strain) const override;

 private:
  int interior_per_sphere_;
  Lubrication lubrication_;
  ConstrainedFactor<double> factor_;

  // Strains are the first five of every sphere's interior rows; higher moments are at rest.
  Eigen::MatrixXd interior_rows(const Eigen::MatrixXd& strain) const;
  Eigen::MatrixXd strain_rows(const Eigen::MatrixXd& all) const;
};

}  // namespace crumble
