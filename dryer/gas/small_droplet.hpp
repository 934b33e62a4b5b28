// What changes where a droplet is small: its vapour pressure (Kelvin), and the gas around it, which is no continuum
// (Knudsen).
#pragma once

#include <cmath>
#include <numbers>

#include "dryer/gas/water_saturation.hpp"

namespace crumble::dryer {

// Vapour pressure above a sphere of radius R over that above a flat surface:
//   exp(2 sigma/(rho_l R_v T R))
// Thomson (1871), Phil. Mag. 42, 448. sigma: N/m, rho_l: kg/m^3, T: K, R: m. Tends to 1 for large R.
inline double kelvin_factor(double surface_tension, double liquid_density, double temperature, double R) {
  return std::exp(2 * surface_tension / (liquid_density * water_gas_constant * temperature * R));
}

// Flux to a sphere between continuum and free molecules, over that of the continuum, every molecule that hits taken up:
//   (1 + Kn)/(1 + 1.71 Kn + 1.333 Kn^2),  Kn = lambda/R
// Fuchs & Sutugin (1971), in: Topics in Current Aerosol Research 2, 1. 1 at Kn = 0, 3/(4 Kn) for large Kn.
inline double fuchs_sutugin(double Kn) { return (1 + Kn) / (1 + (4.0 / 3 + 0.377) * Kn + 4.0 / 3 * Kn * Kn); }

// Mean free path lambda with which that limit is the flux of free molecules, m.
// Of vapour, 4 pi R D_v 3/(4 Kn) = pi R^2 c:              lambda = 3 D_v/c,  c = sqrt(8 R_v T/pi)
inline double vapour_free_path(double diffusivity, double temperature) {
  return 3 * diffusivity / std::sqrt(8 * water_gas_constant * temperature / std::numbers::pi);
}
// Of heat, 4 pi R k_g 3/(4 Kn) = pi R^2 (p c/(2 T)) (g + 1)/(g - 1), the conduction of free molecules (Kennard 1938,
// Kinetic Theory of Gases, section 178) at full accommodation:     lambda = 6 k_g T (g - 1)/(p c (g + 1))
// g: ratio of heat capacities; c = sqrt(8 R T/(pi M)) of the gas; SI.
inline double heat_free_path(double conductivity, double temperature, double pressure, double molar_mass,
                             double heat_capacity_ratio) {
  const double c = std::sqrt(8 * gas_constant * temperature / (std::numbers::pi * molar_mass));
  return 6 * conductivity * temperature * (heat_capacity_ratio - 1) / (pressure * c * (heat_capacity_ratio + 1));
}

}  // namespace crumble::dryer
