// Far-field force-torque-stresslet mobility: what 11 moments of each sphere's surface force do to all others.
//
// Velocities relative to the ambient flow follow from the forces q that the spheres exert ON THE FLUID:
//   w = M q,   w_i = (U - U_inf, Omega - Omega_inf, -E_inf),   q_i = -(F, T, S)     (viscosity 1)
// with F, T, S the loads by the fluid on the spheres, as in Eq. 9 of the paper; M is symmetric positive definite.
//
// Every pair term is the double surface average of the Stokeslet G over the two spheres (Faxen), with the densities
// uniform, rigid rotation and uniform strain, hence a Galerkin projection of the exact single-layer equation:
//   c = (a_i^2 + a_j^2)/6 for force-force, a_i^2/6 + a_j^2/10 for force-stresslet, (a_i^2 + a_j^2)/10 for
//   stresslet-stresslet in (1 + c lap) G; torques have no such term.
// It is exact for one sphere, its resistance is a lower bound of the exact one, and radii may differ.
// Sources: Durlofsky, Brady & Bossis 1987; Kim & Karrila 1991, chapters 3 and 8.
#pragma once

#include <Eigen/Dense>

#include "common/hydro/spheres.hpp"
#include "common/hydro/strain_basis.hpp"

namespace crumble {

// Blocks of the 11 x 11 mobility of sphere i by sphere j, viscosity 1, r = x_i - x_j. Strain basis of strain_basis.hpp.
struct PairMobility {
  Eigen::Matrix<double, 6, 6> motion_force;      // (U, Omega)_i by (F, T)_j
  Eigen::Matrix<double, 6, 5> motion_stresslet;  // (U, Omega)_i by S_j
  Eigen::Matrix<double, 5, 6> strain_force;      // E_i by (F, T)_j
  Eigen::Matrix<double, 5, 5> strain_stresslet;  // E_i by S_j
};
PairMobility pair_mobility(const Vector3& r, double a_i, double a_j);

// The same of a sphere by itself: 1/(6 pi a), 1/(8 pi a^3), 3/(20 pi a^3).
struct SelfMobility {
  double force, torque, stresslet;
  explicit SelfMobility(double a);
};

// A mobility matrix in the order [interior | motion]: first interior_per_sphere entries of every sphere (the five
// strains, then whatever higher moments a method has), then (U, Omega) of every sphere. Only the lower triangle of
// `lower` is filled.
struct MobilityMatrix {
  int spheres = 0;
  int interior_per_sphere = 5;
  Eigen::MatrixXd lower;

  int interior() const { return spheres * interior_per_sphere; }
  int motion() const { return 6 * spheres; }
};

// All spheres, viscosity 1. The second form reuses the memory of `matrix`.
MobilityMatrix far_field_mobility(const Spheres& spheres);
void assemble_far_field(const Spheres& spheres, MobilityMatrix& matrix);

// The 22 x 22 mobility of one pair in the order (U, Omega, E)_1, (U, Omega, E)_2, both triangles; x_2 - x_1 = r.
Eigen::Matrix<double, 22, 22> far_field_pair(const Vector3& r, double a_1, double a_2);

}  // namespace crumble
