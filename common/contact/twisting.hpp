// Resistance of a bonded pair to relative rotation about the line of centres.
#pragma once

#include "common/contact/material.hpp"

namespace crumble {

// k_t = 6 pi gamma_s a^2 (1 - nu)                                                         (paper, Eq. 16)
// Source: (8/3) G b0^3 with the JKR zero-load radius. a: pair_radius, m; result: N m/rad.
double twisting_stiffness(const Material& material, double pair_radius);

// M_t^crit = k_t phi_t^crit, phi_t^crit = 0.05 E b0^3/[18 gamma_s a^2 (1 - nu^2)]         (paper, Eq. 17)
// With the right b0 the angle is 0.05 pi/4 for every material. Source: Dominik & Tielens 1997. Result: N m.
double twisting_limit(const Material& material, double pair_radius);

}  // namespace crumble
