// Surface tension of water, for scenes that say fluid.surface_tension = "water".
#pragma once

namespace crumble::dryer {

inline constexpr double water_critical_temperature = 647.096;  // K
inline constexpr double water_surface_tension_from = 248.15,
                        water_surface_tension_to = water_critical_temperature;  // K

// Surface tension sigma of water against its vapour:
//   sigma = 235.8e-3 N/m x^1.256 (1 - 0.625 x), x = 1 - T/T_c
// IAPWS R1-76 (1976, revised 2014); Vargaftik, Volkov & Voljak (1983), J. Phys. Chem. Ref. Data 12, 817.
// temperature in K, result in N/m, 0 at the critical temperature. From the triple point, 273.16 K; the release states
// that it extrapolates to 248.15 K. Throws std::domain_error outside.
double water_surface_tension(double temperature);

}  // namespace crumble::dryer
