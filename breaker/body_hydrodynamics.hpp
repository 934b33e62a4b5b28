// Hydrodynamics in a frame that turns with the agglomerate, as matrices: what an implicit step needs.
#pragma once

#include <Eigen/Dense>

#include "common/hydro/model.hpp"

namespace crumble::breaker {

// The frame moves as the whole would if it were rigid and free: with U and Omega relative to the ambient flow at the
// centre given by `drift`. In this frame, with y = (U_i, L Omega_i) the velocities relative to the frame, L the mean
// radius, e the strain rate of the flow in the axes of the body, and loads (F_i, T_i/L) by the fluid on the spheres,
//
//   loads = free_loads e - resistance y,
//
// where the columns of free_loads have neither net force nor net torque. This is Eq. 9 of the paper; a turning body
// needs no new matrices, a deforming one does. The far field (cost N^3) and the lubrication (cost N) are renewed
// separately.
class BodyHydrodynamics {
 public:
  // Of the factor of the far field and what comes out of it; all else is float64, so that loads balance to its
  // round-off with either. float32 is twice as fast, and the matrices differ by less than `single_error`, relative.
  enum class Precision { float32, float64 };
  static constexpr double single_error = 1e-5;

  // radius: m; viscosity: Pa s. Far-field rungs only.
  BodyHydrodynamics(const std::vector<double>& radius, double viscosity, const HydroModel& model,
                    Precision precision = Precision::float64);

  // Positions in m; lubrication is renewed with either.
  void renew_far_field(const std::vector<Vector3>& position);
  void renew_lubrication(const std::vector<Vector3>& position);

  double length() const { return length_; }
  const Eigen::MatrixXd& resistance() const { return resistance_; }                           // N s/m, both triangles
  const Eigen::Matrix<double, Eigen::Dynamic, 5>& free_loads() const { return free_loads_; }  // N s per unit strain
  const Eigen::Matrix<double, 3, 5>& turning() const { return turning_; }  // Omega of the frame per unit strain

 private:
  double length_, viscosity_;
  HydroModel model_;
  Precision precision_;
  Spheres reduced_;  // lengths in L, origin at the centre
  MobilityMatrix mobility_;
  Eigen::MatrixXd far_resistance_;  // reduced
  Eigen::MatrixXd far_strain_;      // loads of spheres at rest in unit strains -e, reduced
  Eigen::MatrixXd resistance_;
  Eigen::Matrix<double, Eigen::Dynamic, 5> free_loads_;
  Eigen::Matrix<double, 3, 5> turning_;

  void place(const std::vector<Vector3>& position);
  template <class Scalar>
  void invert_far_field();
};

}  // namespace crumble::breaker
