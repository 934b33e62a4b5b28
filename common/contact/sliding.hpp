// Resistance of a bonded pair to sliding.
#pragma once

#include "common/contact/material.hpp"

namespace crumble {

// k_s = 3.3 [pi gamma_s (1 - nu)]^(1/3)/(2 - nu) (a E/(1 + nu))^(2/3)                     (paper, Eq. 13)
// Source: Mindlin's 8 G* b0 with the JKR zero-load radius (exact factor 3.3019). a: pair_radius, m; result: N/m.
double sliding_stiffness(const Material& material, double pair_radius);

// F_s^crit = 0.05 pi G b0^2, G = E/[2 (1 + nu)]                                           (paper, Eq. 14)
// Eq. 14 prints this force as a displacement; the displacement at the limit is F_s^crit/k_s.
// Source: Dominik & Tielens 1997. zero_load_radius b0: m; result: N.
double sliding_limit(const Material& material, double zero_load_radius);

}  // namespace crumble
