// Viscosity of water, for scenes that say fluid.viscosity = "water".
#pragma once

namespace crumble::dryer {

inline constexpr double water_viscosity_from = 253.15, water_viscosity_to = 383.15;  // range of the correlation, K

// Viscosity mu of liquid water at 0.1 MPa:
//   mu = 1e-6 Pa s sum of A_i (T/300 K)^(B_i), i = 1 ... 4
// IAPWS R12-08 (2008), simplified correlation for liquid water at 0.1 MPa; Patek, Hruby, Klomfar, Souckova & Harvey
// (2009), J. Phys. Chem. Ref. Data 38, 21.
// temperature in K, result in Pa s. Metastable below 273.15 K and above 372.8 K. Throws std::domain_error outside the
// range of the correlation.
double water_viscosity(double temperature);

}  // namespace crumble::dryer
