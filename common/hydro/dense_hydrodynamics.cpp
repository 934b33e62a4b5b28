#include "common/hydro/dense_hydrodynamics.hpp"

namespace crumble {

DenseHydrodynamics::DenseHydrodynamics(const Spheres& spheres, double viscosity, const HydroModel& model)
    : Hydrodynamics(spheres, viscosity),
      interior_per_sphere_(5),
      lubrication_(lubrication(reduced(), model)),
      factor_([&] {
        MobilityMatrix matrix = mobility_matrix(reduced(), model);
        interior_per_sphere_ = matrix.interior_per_sphere;
        return ConstrainedFactor<double>(std::move(matrix), lubrication_.motion_resistance(size()));
      }()) {}

Eigen::MatrixXd DenseHydrodynamics::interior_rows(const Eigen::MatrixXd& strain) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(factor_.interior() + factor_.motion(), strain.cols());
  for (int i = 0; i < size(); ++i) all.middleRows(interior_per_sphere_ * i, 5) = strain.middleRows(5 * i, 5);
  return all;
}

Eigen::MatrixXd DenseHydrodynamics::strain_rows(const Eigen::MatrixXd& all) const {
  Eigen::MatrixXd strain(5 * size(), all.cols());
  for (int i = 0; i < size(); ++i) strain.middleRows(5 * i, 5) = all.middleRows(interior_per_sphere_ * i, 5);
  return strain;
}

void DenseHydrodynamics::solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain,
                                          Eigen::MatrixXd& q_motion, Eigen::MatrixXd& q_strain) const {
  Eigen::MatrixXd x = interior_rows(w_strain);
  x.bottomRows(factor_.motion()) = w_motion;
  factor_.solve_resistance(x);
  q_motion = x.bottomRows(factor_.motion());
  q_strain = strain_rows(x);
  lubrication_.add(w_motion, w_strain, q_motion, q_strain);
}

void DenseHydrodynamics::solve_mobility(const Eigen::MatrixXd& q_motion, const Eigen::MatrixXd& w_strain,
                                        Eigen::MatrixXd& w_motion, Eigen::MatrixXd& q_strain) const {
  // Lubrication by the known strain counts as a known load; that by the velocities is in the factor.
  Eigen::MatrixXd by_strain = lubrication_.motion_loads_of_strain(size(), w_strain);
  Eigen::MatrixXd x = interior_rows(w_strain);
  x.bottomRows(factor_.motion()) = q_motion - by_strain;
  factor_.solve_mobility(x, &w_motion);
  q_strain = strain_rows(x);
  lubrication_.add(w_motion, w_strain, by_strain, q_strain);
}

}  // namespace crumble
