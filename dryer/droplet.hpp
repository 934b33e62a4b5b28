// The evaporating droplet: its radius in time.
#pragma once

#include <cmath>

namespace crumble::dryer {

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

  // Pe = R0^2/(D tau) = k/D: how much faster the surface recedes than particles diffuse away from it. D: m^2/s, > 0.
  //                                                                                       (paper, Eq. 22)
  double peclet(double diffusivity) const { return initial_radius * initial_radius / (lifetime * diffusivity); }

  // Speed of the receding front, v = -dR/dt = k/(2 R), m/s.                               (paper, Eq. 24)
  double front_speed(double R) const { return initial_radius * initial_radius / (2 * lifetime * R); }
};

}  // namespace crumble::dryer
