// Charge and potential of the surface of one sphere in an electrolyte.
#pragma once

#include "common/surface_forces/electrolyte.hpp"

namespace crumble {

// Charge density of a sphere of radius a at the potential psi, y = e psi/kT:
//   sigma = (2 eps kappa kT/e) sinh(y/2) sqrt(1 + (2/(kappa a))/cosh^2(y/4)
//                                               + (8/(kappa a)^2) ln cosh(y/4)/sinh^2(y/2))
// Source: Ohshima, Healy & White 1982, J. Colloid Interface Sci. 90, 17. kappa a -> infinity: Grahame 1947; small y:
// eps kappa psi (1 + 1/(kappa a)), exact for any kappa a (Debye & Hueckel 1923). Against the numerical solution of the
// Poisson-Boltzmann equation for y up to 6 within the error of the test: see README.md.
// a: m; psi: V; result: C/m^2, of the sign of psi.
double surface_charge(const Electrolyte& electrolyte, double a, double potential);
// The inverse, V.
double surface_potential(const Electrolyte& electrolyte, double a, double charge);

}  // namespace crumble
