// What a stage asks of the fluid: loads of moving spheres, velocities of loaded spheres, a rigid body in a flow.
//
// Layouts (N spheres, any number of columns = right-hand sides)
//   six-vectors, 6N rows: (U_i, Omega_i) m/s and rad/s, or (F_i, T_i) N and N m about the sphere's own centre
//   five-vectors, 5N rows: stresslets S_i, N m, in the basis of strain_basis.hpp
// Signs: loads are exerted BY THE FLUID ON THE SPHERES, as in Eq. 9 of the paper. One sphere:
//   F = -6 pi mu a (U - U_inf),  T = -8 pi mu a^3 (Omega - Omega_inf),  S = +(20/3) pi mu a^3 E_inf.
// So spheres without inertia under external forces F_ext move as mobility(-F_ext, flow) says.
#pragma once

#include <Eigen/Dense>

#include "common/hydro/linear_flow.hpp"
#include "common/hydro/spheres.hpp"

namespace crumble {

struct SphereLoads {
  Eigen::MatrixXd force_torque;  // six-vectors
  Eigen::MatrixXd stresslet;     // five-vectors
};

struct SphereMotion {
  Eigen::MatrixXd velocity;   // six-vectors
  Eigen::MatrixXd stresslet;  // five-vectors
};

// Stokesian dynamics: loads = mu R (motion relative to the ambient flow) of all spheres    (paper, Eq. 9)
// What stands in R is the choice of the method: far_field.hpp, lubrication.hpp, multipole.hpp.
class Hydrodynamics {
 public:
  // Positions and radii in m, viscosity in Pa s. Throws std::invalid_argument on geometry that check() refuses.
  Hydrodynamics(const Spheres& spheres, double viscosity);
  virtual ~Hydrodynamics() = default;
  Hydrodynamics(const Hydrodynamics&) = delete;
  Hydrodynamics& operator=(const Hydrodynamics&) = delete;

  int size() const { return reduced_.size(); }

  // Loads on spheres that move with given velocities (one column) in an ambient flow.
  SphereLoads resistance(const Eigen::VectorXd& velocity, const LinearFlow& flow) const;

  // Velocities of spheres on which the fluid exerts given forces and torques (one column) in an ambient flow.
  SphereMotion mobility(const Eigen::VectorXd& force_torque, const LinearFlow& flow) const;

  // Loads for velocities relative to the ambient flow (six-vectors) and the same ambient strain at every sphere (5
  // components a column, 1/s): many right-hand sides at once.
  SphereLoads relative_resistance(const Eigen::MatrixXd& relative_velocity, const Eigen::MatrixXd& strain) const;

  // (U_inf, Omega_inf) at every sphere.
  Eigen::VectorXd ambient(const LinearFlow& flow) const;

 protected:
  // Reduced problem: lengths in mean radii, viscosity 1; w are velocities relative to the ambient flow, its strain part
  // being -E_inf, and q the loads exerted on the fluid, so that q = R w with R positive definite.
  virtual void solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain,
                                Eigen::MatrixXd& q_motion, Eigen::MatrixXd& q_strain) const = 0;
  virtual void solve_mobility(const Eigen::MatrixXd& q_motion, const Eigen::MatrixXd& w_strain,
                              Eigen::MatrixXd& w_motion, Eigen::MatrixXd& q_strain) const = 0;

  const Spheres& reduced() const { return reduced_; }
  // For operators that follow a moving configuration: new positions, m.
  void move(const std::vector<Vector3>& position);

 private:
  double length_, viscosity_;
  Spheres reduced_;

  void scale(Eigen::MatrixXd& six, double linear, double angular) const;
};

}  // namespace crumble
