// Drag of a rigid body in the numbers that people compare.
#pragma once

#include <Eigen/Dense>

namespace crumble::rigidstress {

struct MobilityNumbers {
  Eigen::Vector3d drag;            // eigenvalues of force against velocity without rotation, ascending
  Eigen::Vector3d rotation;        // eigenvalues of torque against rotation about the centre of mass, ascending
  double hydrodynamic_radius = 0;  // of the sphere that diffuses as fast: 3/(6 pi trace of the mobility)
};

// drag: (F, T) = -drag (U, Omega) about one point, at viscosity 1 Pa s, so that forces are lengths. Results in the same
// unit: m, m^3, m. The mobility is taken about the centre of mobility, where its coupling to rotation is symmetric and
// its trace least (Kim & Karrila 1991, 5.2; what diffusion over long times sees).
MobilityNumbers mobility_numbers(const Eigen::Matrix<double, 6, 6>& drag);

}  // namespace crumble::rigidstress
