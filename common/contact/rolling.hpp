// Resistance of a bonded pair to rolling (bending of the bond).
#pragma once

#include "common/contact/material.hpp"

namespace crumble {

// k_r = 3 pi gamma_s a^2                                                                  (paper, Eq. 20)
// A torque per relative angle theta_r, d(theta_r)/dt = (I - nn)(W_j - W_i): Eqs. 18-19 call the integral of the length
// rate a d(theta_r)/dt by the same name, which would count a twice. Sources: Dominik & Tielens 1997 and Marshall 2009,
// 4 F_po xi with xi = R* theta_r; equally the bending stiffness of half-spaces bonded over a disc of radius b0,
// (2/3) E b0^3/(1 - nu^2). a: pair_radius, m; result: N m/rad.
double rolling_stiffness(const Material& material, double pair_radius);

// M_r^crit = k_r phi_r^crit, phi_r^crit = 0.2 b0/a                                        (paper, Eq. 21)
// Source: Dominik & Tielens 1997 (the coefficient is theirs only in order of magnitude). Result: N m.
double rolling_limit(const Material& material, double pair_radius, double zero_load_radius);

}  // namespace crumble
