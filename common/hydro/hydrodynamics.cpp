#include "common/hydro/hydrodynamics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace crumble {

namespace {

Spheres checked(const Spheres& spheres) {
  check(spheres);
  return scaled(spheres, 1 / mean_radius(spheres));
}

void require_rows(const char* what, Eigen::Index rows, Eigen::Index wanted) {
  if (rows != wanted) throw std::invalid_argument(fmt::format("{}: {} rows given, {} needed", what, rows, wanted));
}

}  // namespace

Hydrodynamics::Hydrodynamics(const Spheres& spheres, double viscosity)
    : length_(0), viscosity_(viscosity), reduced_(checked(spheres)) {
  length_ = mean_radius(spheres);
  if (!(viscosity > 0) || !std::isfinite(viscosity))
    throw std::invalid_argument(fmt::format("viscosity of the fluid is {} Pa s", viscosity));
}

void Hydrodynamics::move(const std::vector<Vector3>& position) {
  Spheres moved = reduced_;
  moved.position = position;
  for (auto& x : moved.position) x /= length_;
  check(moved);
  reduced_ = std::move(moved);
}

void Hydrodynamics::scale(Eigen::MatrixXd& six, double linear, double angular) const {
  for (int i = 0; i < size(); ++i) {
    six.middleRows(6 * i, 3) *= linear;
    six.middleRows(6 * i + 3, 3) *= angular;
  }
}

Eigen::VectorXd Hydrodynamics::ambient(const LinearFlow& flow) const {
  Eigen::VectorXd result(6 * size());
  for (int i = 0; i < size(); ++i)
    result.segment<6>(6 * i) << flow.velocity_at(length_ * reduced_.position[i]), flow.angular_velocity();
  return result;
}

SphereLoads Hydrodynamics::resistance(const Eigen::VectorXd& velocity, const LinearFlow& flow) const {
  require_rows("velocities", velocity.rows(), 6 * size());
  return relative_resistance(velocity - ambient(flow), flow.strain());
}

SphereLoads Hydrodynamics::relative_resistance(const Eigen::MatrixXd& relative_velocity,
                                               const Eigen::MatrixXd& strain) const {
  require_rows("relative velocities", relative_velocity.rows(), 6 * size());
  require_rows("strain", strain.rows(), 5);
  Eigen::MatrixXd w = relative_velocity;
  scale(w, 1 / length_, 1);
  SphereLoads loads;
  solve_resistance(w, (-strain).replicate(size(), 1), loads.force_torque, loads.stresslet);
  const double force = -viscosity_ * length_ * length_;
  scale(loads.force_torque, force, force * length_);
  loads.stresslet *= force * length_;
  return loads;
}

SphereMotion Hydrodynamics::mobility(const Eigen::VectorXd& force_torque, const LinearFlow& flow) const {
  require_rows("loads", force_torque.rows(), 6 * size());
  const double force = -viscosity_ * length_ * length_;
  Eigen::MatrixXd q = force_torque;
  scale(q, 1 / force, 1 / (force * length_));
  SphereMotion motion;
  solve_mobility(q, (-flow.strain()).replicate(size(), 1), motion.velocity, motion.stresslet);
  scale(motion.velocity, length_, 1);
  motion.velocity += ambient(flow);
  motion.stresslet *= force * length_;
  return motion;
}

}  // namespace crumble
