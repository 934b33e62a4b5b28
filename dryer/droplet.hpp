// The evaporating droplet: its radius in time.
#pragma once

#include <cmath>
#include <memory>

#include "dryer/drying_curve.hpp"

namespace crumble::dryer {

struct Droplet {
  double initial_radius = 0;   // R0, m
  double lifetime = 0;         // tau, s
  double surface_tension = 0;  // sigma, N/m; times wetting_factor() where the liquid does not wet the particles

  // What a gas makes of it, in place of Eq. 7; `lifetime` is then the curve's. Without one the droplet follows Eq. 7.
  std::shared_ptr<const DryingCurve> curve = nullptr;

  // R(t) = sqrt(R0^2 - k t), k = R0^2/tau; 0 after the lifetime.                          (paper, Eq. 7)
  double radius(double time) const {
    if (curve) return curve->radius(time);
    const double left = 1 - time / lifetime;
    return left > 0 ? initial_radius * std::sqrt(left) : 0;
  }

  // Instant at which the front is at R, s: the inverse of radius().
  double time_at(double R) const {
    if (curve) return curve->time_at(R);
    const double x = R / initial_radius;
    return lifetime * (1 - x) * (1 + x);
  }

  // Pe = R0^2/(D tau) = k/D, k the mean over the lifetime: how much faster the surface recedes than particles diffuse
  // away from it. D: m^2/s, > 0.
  //                                                                                       (paper, Eq. 22)
  double peclet(double diffusivity) const { return initial_radius * initial_radius / (lifetime * diffusivity); }

  // Speed of the receding front, v = -dR/dt = k/(2 R), m/s.                               (paper, Eq. 24)
  double front_speed(double R) const {
    return curve ? curve->front_speed(R) : initial_radius * initial_radius / (2 * lifetime * R);
  }
};

}  // namespace crumble::dryer
