// Mobility of many spheres with all moments of their surface forces up to degree L: the far field of far_field.hpp is
// L = 1, and L -> infinity is the exact solution, touching spheres included.
//
// Method. The single-layer equation of Stokes flow is projected (Galerkin) on vector spherical harmonics on every
// sphere. With R_jm harmonic polynomials of degree j, the densities on the unit sphere n are the homogeneous vector
// polynomials
//   W_jm = grad R_jm (degree j - 1),   X_jm = n x grad R_jm (degree j),   V_jm = grad R_jm - (2j + 1) n R_jm (degree j
//   + 1)
// and all those of degree <= L are kept: Cartesian force densities of degree <= L without the uniform pressure, which
// moves no fluid. W_1 carries the force, X_1 the torque, W_2 the stresslet. They are eigenfunctions of one sphere's own
// single layer: u = lambda a f / mu with lambda = (j + 1)/((2j + 1)(2j - 1)), 1/(2j + 1), j/((2j + 1)(2j + 3)).
// Between two spheres, averaging a polynomial density of degree l over a sphere of radius a is a derivative:
//   int f(n) h(d + a n) dn = 4 pi a^l/(2l + 1)!! f(grad) (1 + a^2 lap/(2 (2l + 3))) h(d)   for biharmonic h,
// so that every pair term is a closed form in derivatives of |d| and 1/|d| (see multipole.cpp). The single layer is a
// positive form, hence so is any Galerkin matrix of it; drag and stress energy rise to the exact ones as L grows.
// Sources of the ingredients: Lamb 1932, section 335; Cichocki, Felderhof, Hinsen, Wajnryb & Blawzdziewicz 1994 (force
// multipoles); Corona & Veerapaneni 2018 (spectrum of the single layer). The pair terms are derived here.
#pragma once

#include "common/hydro/far_field.hpp"

namespace crumble {

// Unknowns of one sphere: 3 (L + 1)^2 - 1.
constexpr int multipole_unknowns(int order) { return 3 * (order + 1) * (order + 1) - 1; }

inline constexpr int highest_multipole_order = 20;  // beyond it factorials spoil the last digits

// Layout of far_field.hpp; the first five interior unknowns of a sphere are its strain and stresslet in the units of
// the far field, the others (densities of unit norm) are scaled so that a sphere's own entry is one. Viscosity 1.
// Throws std::invalid_argument unless 1 <= order <= highest_multipole_order.
MobilityMatrix multipole_mobility(const Spheres& spheres, int order);

}  // namespace crumble
