// What one free rigid agglomerate does in any flow that is linear in space: everything follows from five strains.
#pragma once

#include "common/hydro/rigid_body.hpp"
#include "common/rigid/network.hpp"

namespace crumble {

// Body frame, SI, the strain basis of strain_basis.hpp. All of it is proportional to the viscosity but `drift`.
struct Response {
  Vector3 centre = Vector3::Zero();    // centre of mass, m
  Eigen::Matrix<double, 6, 6> drag;    // (F, T about the centre) on the body = -drag (U, Omega)
  Eigen::Matrix<double, 6, 5> drift;   // (U m, Omega) relative to the ambient flow at the centre, unit strains
  Eigen::MatrixXd load;                // 6 rows a contact: force N s and moment N m s on j at the contact point
  Eigen::MatrixXd tension;             // a row a contact: N, N s; positive: tension
  double imbalance = 0, residual = 0;  // BondLoads
};

Response respond(const Network& network, const RigidBodyResponse& body);

// The tension of every contact from its load: the force on j pulled back along the normal.
Eigen::MatrixXd tension_rows(const Eigen::MatrixXd& load, const std::vector<Vector3>& normal);

// A strain rate with three eigenvalues can be turned in any way: what is the largest tension N = A : E of one contact?
// The eigenvectors of E in line with those of A, the largest with the largest (von Neumann's trace inequality); for
// planar elongation and simple shear (lambda_max - lambda_min)/2 of A per unit shear rate.
// a: row of `tension`; strain: any tensor with the wanted eigenvalues, 1/s; result N.
double worst_tension(const Vector5& a, const Eigen::Matrix3d& strain);

// Rotation body -> laboratory, such that the contact's tension in the flow is the worst.
Eigen::Matrix3d worst_orientation(const Vector5& a, const Eigen::Matrix3d& strain);

// The contact that breaks first, all orientations allowed: largest worst tension over pull-off force.
struct WorstContact {
  int contact = -1;    // -1: there are no contacts
  double tension = 0;  // N, for the given strain rate
};
WorstContact worst_contact(const Eigen::MatrixXd& tension, const std::vector<double>& pull_off,
                           const Eigen::Matrix3d& strain);

}  // namespace crumble
