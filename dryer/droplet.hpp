// The evaporating droplet: its radius in time and the capillary force at its surface.
#pragma once

#include <cmath>
#include <numbers>

namespace crumble {

struct Droplet {
  double initial_radius = 0;   // R0, m
  double lifetime = 0;         // tau, s
  double surface_tension = 0;  // sigma, N/m; times wetting_factor() where the liquid does not wet the particles

  // R(t) = sqrt(R0^2 - k t), k = R0^2/tau; 0 after the lifetime.                          (paper, Eq. 7)
  double radius(double time) const {
    const double left = 1 - time / lifetime;
    return left > 0 ? initial_radius * std::sqrt(left) : 0;
  }

  // Instant at which the front is at R, s: the inverse of radius().
  double time_at(double R) const {
    const double x = R / initial_radius;
    return lifetime * (1 - x) * (1 + x);
  }

  // Speed of the receding front, v = -dR/dt = k/(2 R), m/s.                               (paper, Eq. 24)
  double front_speed(double R) const { return initial_radius * initial_radius / (2 * lifetime * R); }
};

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

}  // namespace crumble
