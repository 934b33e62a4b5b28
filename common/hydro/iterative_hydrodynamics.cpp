#include "common/hydro/iterative_hydrodynamics.hpp"

#include <stdexcept>

namespace crumble {

namespace {

const HydroModel& far_field_rung(const HydroModel& model) {
  if (model.rung == Rung::multipole)
    throw std::invalid_argument("hydrodynamics by iteration is for the far-field rungs, not for multipoles");
  return model;
}

}  // namespace

IterativeHydrodynamics::IterativeHydrodynamics(const Spheres& spheres, double viscosity, const HydroModel& model)
    : Hydrodynamics(spheres, viscosity),
      model_(far_field_rung(model)),
      lubrication_(lubrication(reduced(), model_)),
      far_field_(reduced()) {}

void IterativeHydrodynamics::follow(const std::vector<Vector3>& position) {
  move(position);
  lubrication_ = lubrication(reduced(), model_);
  far_field_ = FarFieldSum(reduced());
}

Eigen::VectorXd IterativeHydrodynamics::product(const Eigen::VectorXd& f) const {
  ++products_;
  Eigen::VectorXd w(f.size());
  far_field_.apply(f.data(), w.data());
  return w;
}

Eigen::VectorXd IterativeHydrodynamics::saddle(const Eigen::VectorXd& f) const {
  Eigen::VectorXd w = product(f);
  const Eigen::MatrixXd u = w.tail(6 * size()), no_strain = Eigen::MatrixXd::Zero(5 * size(), 1);
  Eigen::MatrixXd loads = f.tail(6 * size()), unused = no_strain;
  lubrication_.add(u, no_strain, loads, unused);
  w.tail(6 * size()) = loads;
  return w;
}

void IterativeHydrodynamics::solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain,
                                              Eigen::MatrixXd& q_motion, Eigen::MatrixXd& q_strain) const {
  const int n = size();
  q_motion.resize(6 * n, w_motion.cols());
  q_strain.resize(5 * n, w_motion.cols());
  for (Eigen::Index c = 0; c < w_motion.cols(); ++c) {
    Eigen::VectorXd w(11 * n);
    w << w_strain.col(c), w_motion.col(c);
    const Eigen::VectorXd f = solve_far_field([this](const Eigen::VectorXd& v) { return product(v); }, w);
    q_strain.col(c) = f.head(5 * n);
    q_motion.col(c) = f.tail(6 * n);
    solved(c, w_motion.cols());
  }
  lubrication_.add(w_motion, w_strain, q_motion, q_strain);
}

void IterativeHydrodynamics::solve_mobility(const Eigen::MatrixXd& q_motion, const Eigen::MatrixXd& w_strain,
                                            Eigen::MatrixXd& w_motion, Eigen::MatrixXd& q_strain) const {
  const int n = size();
  Eigen::MatrixXd by_strain = lubrication_.motion_loads_of_strain(n, w_strain);
  w_motion.resize(6 * n, q_motion.cols());
  q_strain.resize(5 * n, q_motion.cols());
  for (Eigen::Index c = 0; c < q_motion.cols(); ++c) {
    Eigen::VectorXd b(11 * n);
    b << w_strain.col(c), q_motion.col(c) - by_strain.col(c);
    const Eigen::VectorXd f = solve_saddle([this](const Eigen::VectorXd& v) { return saddle(v); }, b);
    w_motion.col(c) = product(f).tail(6 * n);
    q_strain.col(c) = f.head(5 * n);
    solved(c, q_motion.cols());
  }
  lubrication_.add(w_motion, w_strain, by_strain, q_strain);
}

}  // namespace crumble
