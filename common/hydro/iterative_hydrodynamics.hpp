// Far-field rungs solved by iteration: products with M are summed over pairs, neither M nor its inverse is formed.
#pragma once

#include <functional>
#include <optional>

#include "common/hydro/far_field_sum.hpp"
#include "common/hydro/hydrodynamics.hpp"
#include "common/hydro/model.hpp"

namespace crumble {

// Both problems in far-field loads f, with u the velocities M f of the spheres and D the pair lubrication:
//   resistance   M f = w, then the lubrication of the given motion
//   mobility     (M f)_strain = -E,   f_motion + (D u)_motion = known loads - D of the ambient strain   (saddle form)
// What remains to a derived class is to solve these for one right-hand side.
class IterativeHydrodynamics : public Hydrodynamics {
 public:
  long products() const { return products_; }  // with M, since construction

 protected:
  // Throws std::invalid_argument for multipoles.
  IterativeHydrodynamics(const Spheres& spheres, double viscosity, const HydroModel& model);

  // New positions, m, of the spheres and of what is built on them here.
  void follow(const std::vector<Vector3>& position);

  using Operator = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
  virtual Eigen::VectorXd solve_far_field(const Operator& mobility, const Eigen::VectorXd& w) const = 0;
  virtual Eigen::VectorXd solve_saddle(const Operator& saddle, const Eigen::VectorXd& b) const = 0;
  // Right-hand side `column` of `columns` has been solved.
  virtual void solved(Eigen::Index /*column*/, Eigen::Index /*columns*/) const {}

  const Lubrication& pair_lubrication() const { return lubrication_; }

  void solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& q_motion,
                        Eigen::MatrixXd& q_strain) const override;
  void solve_mobility(const Eigen::MatrixXd& q_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& w_motion,
                      Eigen::MatrixXd& q_strain) const override;

 private:
  HydroModel model_;
  Lubrication lubrication_;
  FarFieldSum far_field_;
  mutable long products_ = 0;  // counting work does not change what the operator is

  Eigen::VectorXd product(const Eigen::VectorXd& f) const;
  Eigen::VectorXd saddle(const Eigen::VectorXd& f) const;
};

}  // namespace crumble
