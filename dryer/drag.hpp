// Resistance of the liquid to one sphere (free draining: no interaction through the liquid).
#pragma once

#include <cmath>
#include <numbers>

namespace crumble::dryer {

// F = -zeta v, zeta = 6 pi mu a (Stokes), N s/m.                                                  (paper, Eq. 2)
constexpr double drag_coefficient(double viscosity, double a) { return 6 * std::numbers::pi * viscosity * a; }

// T = -zeta_r W, zeta_r = 8 pi mu a^3 (Kirchhoff), N m s.                                            (paper, Eq. 3)
constexpr double rotational_drag_coefficient(double viscosity, double a) {
  return 8 * std::numbers::pi * viscosity * a * a * a;
}

// Amplitude of the thermal load on one component, to be multiplied by a number uniform in (-1/2, 1/2) for each step:
//   F_Brown = sqrt(24 kT zeta/dt) chi                                                     (paper, Eq. 4)
//   T_Brown = sqrt(24 kT zeta_r/dt) chi                                                   (paper, Eq. 5)
// Its variance is 2 kT zeta/dt: fluctuation and dissipation balance while dt is short against m/zeta. kT in J, drag in
// N s/m (N m s), dt in s; result N (N m). Source: Grassia, Hinch & Nitschke 1995.
inline double random_load(double thermal_energy, double drag, double dt) {
  return std::sqrt(24 * thermal_energy * drag / dt);
}

constexpr double boltzmann_constant = 1.380649e-23;  // J/K, exact (SI 2019)

// D = kT/(6 pi mu a), m^2/s.                                                              (paper, Eq. 23)
constexpr double diffusivity(double temperature, double viscosity, double a) {
  return boltzmann_constant * temperature / drag_coefficient(viscosity, a);
}

}  // namespace crumble::dryer
