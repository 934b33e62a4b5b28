// Resistance of the liquid to one sphere (free draining: no interaction through the liquid).
#pragma once

#include <numbers>

namespace crumble {

// F = -zeta v, zeta = 6 pi mu a, N s/m.                                                   (paper, Eq. 2; Stokes)
constexpr double drag_coefficient(double viscosity, double a) { return 6 * std::numbers::pi * viscosity * a; }

// T = -zeta_r W, zeta_r = 8 pi mu a^3, N m s.                                             (paper, Eq. 3; Kirchhoff)
constexpr double rotational_drag_coefficient(double viscosity, double a) {
  return 8 * std::numbers::pi * viscosity * a * a * a;
}

constexpr double boltzmann_constant = 1.380649e-23;  // J/K, exact (SI 2019)

// D = kT/(6 pi mu a), m^2/s.                                                              (paper, Eq. 23)
constexpr double diffusivity(double temperature, double viscosity, double a) {
  return boltzmann_constant * temperature / drag_coefficient(viscosity, a);
}

}  // namespace crumble
