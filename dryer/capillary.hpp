// The capillary force: what the receding surface of the droplet does to a particle that it cuts.
#pragma once

#include <cmath>
#include <numbers>

#include "dryer/droplet.hpp"

namespace crumble::dryer {

// Largest force with which a liquid that meets the particle at the contact angle theta holds it back at the surface, in
// that on a perfectly wetted one (theta = 0):
//   max over phi of  sin(phi) sin(phi + theta) = cos^2(theta/2)
// at the angle phi of the contact line on the sphere; flat surface, no weight. Eq. 8 times this factor has the right
// maximum for any theta, as Eq. 8 has for theta = 0; where along the way out of the liquid it is reached stays that of
// Eq. 8. Source: Scheludko & Nikolov 1975. theta: rad, 0 to pi; result: 1 to 0.
inline double wetting_factor(double contact_angle) {
  const double c = std::cos(contact_angle / 2);
  return c * c;
}

// Whether the liquid has left the particle behind.
inline bool is_dry(double a, double r, double R) { return r > R + a; }

// Whether the surface cuts the particle; a droplet that is inside the particle (r + R <= a) does not.
inline bool surface_cuts(double a, double r, double R) { return r < R + a && r > R - a && r + R > a; }

// Force on a particle that the surface cuts, towards the centre of the droplet:
//   F_c = 2 pi sigma sqrt(a^2 - (r - R)^2)  for |r - R| <= a, else 0                      (paper, Eq. 8)
// The equation is valid only while the surface cuts the particle: inside (r < R - a) and outside (r > R + a) there is
// none, nor where the last of the liquid is smaller than the particle and inside it. offset = r - R, m; result N >= 0.
inline double capillary_force(double surface_tension, double a, double offset) {
  const double squared = (a - offset) * (a + offset);
  return squared > 0 ? 2 * std::numbers::pi * surface_tension * std::sqrt(squared) : 0;
}

// dF_c/d(offset), N/m: positive (restoring) on the inner half, negative on the outer, infinite at first touch.
inline double capillary_slope(double surface_tension, double a, double offset) {
  const double squared = (a - offset) * (a + offset);
  return squared > 0 ? -2 * std::numbers::pi * surface_tension * offset / std::sqrt(squared) : 0;
}

// Rate at which a free particle comes to rest where the surface at R drags it along: F_c = zeta v at a depth d within
// it with F_c = 2 pi sigma sqrt(2 a d), of the slope F_c/(2 d), 1/s:
//   (2 pi sigma)^2 a/(zeta^2 v)
// zeta: N s/m.
inline double surface_rate(const Droplet& droplet, double a, double zeta, double R) {
  const double pull = 2 * std::numbers::pi * droplet.surface_tension / zeta;
  return pull * pull * a / droplet.front_speed(R);
}

// Work against F_c from the inside (offset <= -a) outwards, J: the integral of Eq. 8.
inline double capillary_energy(double surface_tension, double a, double offset) {
  if (offset <= -a) return 0;
  const double area = offset >= a ? std::numbers::pi * a * a / 2
                                  : 0.5 * (offset * std::sqrt((a - offset) * (a + offset)) +
                                           a * a * (std::asin(offset / a) + std::numbers::pi / 2));
  return 2 * std::numbers::pi * surface_tension * area;
}

}  // namespace crumble::dryer
