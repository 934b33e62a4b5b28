// Exact resistance of one pair of spheres as a matrix, in any orientation; mobility scalars by inversion.
#pragma once

#include <Eigen/Dense>

#include "common/hydro/strain_basis.hpp"
#include "common/hydro/two_sphere.hpp"

namespace crumble {

using PairMatrix = Eigen::Matrix<double, 22, 22>;

// Resistance of two spheres, viscosity 1: loads by the spheres on the fluid for velocities relative to the ambient
// flow,
//   (F, T, S)_1, (F, T, S)_2  =  R  (U, Omega, E')_1, (U, Omega, E')_2,      E' = -(ambient rate of strain)
// per sphere 11 entries: 3, 3 and the 5 components in the orthonormal basis of strain_basis.hpp. Symmetric, positive
// definite.
//   r = x_2 - x_1, radii a_1, a_2: one length unit L; R then has the units L, L^2, L^3 (times viscosity).
//   gap_floor: in mean radii, see effective_gap; overlapping spheres are taken at the floor. Only the direction of r
//   enters besides the gap. Throws std::invalid_argument when the centres coincide.
PairMatrix two_sphere_pair(const Eigen::Vector3d& r, double a_1, double a_2, double gap_floor = default_gap_floor);

// The same from scalars: e the unit vector from 1 to 2, `one` the scalars of sphere 1 (11, 12), `two` those of sphere 2
// on the same axis (22, 21), a the mean radius.
PairMatrix two_sphere_pair(const Eigen::Vector3d& e, double a, const ResistanceScalars& one,
                           const ResistanceScalars& two);

// Mobility scalars of sphere 1, for loads and strain given on both spheres:
//   (U, Omega) = a F + b T + g E',  S = g F + h T + m E'   with the tensors of ResistanceScalars, e from 1 to 2.
// First index: the sphere whose velocity (xa ... yc) or stresslet (xg ... zm) it is; yb is the angular velocity of a
// force. E' = -(ambient rate of strain), loads on the fluid, as in the resistance problem.
// Unit: a and b, c over 1/(6 pi mu a^k), k = 1, 2, 3; g and h carry a and 1; m over 6 pi mu a^3 (a the mean radius).
struct MobilityScalars {
  double xa11 = 0, xa12 = 0, ya11 = 0, ya12 = 0, yb11 = 0, yb12 = 0, xc11 = 0, xc12 = 0, yc11 = 0, yc12 = 0;
  double xg11 = 0, xg12 = 0, yg11 = 0, yg12 = 0, yh11 = 0, yh12 = 0;
  double xm11 = 0, xm12 = 0, ym11 = 0, ym12 = 0, zm11 = 0, zm12 = 0;
};

// By inversion of the resistance, so as exact as it is: relative error of the table over the conditioning 1/gap.
MobilityScalars two_sphere_mobility(double gap, double radius_ratio = 1);

}  // namespace crumble
