// Water and its vapour in equilibrium: saturation pressure, densities, latent heat.
#pragma once

namespace crumble::dryer {

inline constexpr double water_triple_point = 273.16;                           // K; below it the droplet freezes
inline constexpr double gas_constant = 8.314462618;                            // J/(mol K), exact (SI 2019)
inline constexpr double water_molar_mass = 18.015268e-3;                       // kg/mol, IAPWS
inline constexpr double water_gas_constant = gas_constant / water_molar_mass;  // R_v, J/(kg K)

// Heat capacity of liquid water, J/(kg K): 4217 at 0 C, 4178 at 35 C, 4216 at 100 C (ISO/TR 15377, CRC Handbook), so
// constant within 0.9 %. It matters while the droplet warms up only.
inline constexpr double water_heat_capacity = 4184;

// With theta = 1 - T/647.096 K; p_c = 22.064 MPa, rho_c = 322 kg/m^3:
//   ln(p/p_c)  = (T_c/T) (a1 theta + a2 theta^1.5 + a3 theta^3 + a4 theta^3.5 + a5 theta^4 + a6 theta^7.5)
//   rho_l/rho_c = 1 + b1 theta^(1/3) + b2 theta^(2/3) + b3 theta^(5/3) + b4 theta^(16/3) + b5 theta^(43/3)
//                 + b6 theta^(110/3)
//   ln(rho_v/rho_c) = c1 theta^(2/6) + c2 theta^(4/6) + c3 theta^(8/6) + c4 theta^(18/6) + c5 theta^(37/6)
//                     + c6 theta^(71/6)
// IAPWS SR1-86 (1992); Wagner & Pruss (1993), J. Phys. Chem. Ref. Data 22, 783. temperature in K from the triple point
// to the critical point; results in Pa and kg/m^3; not a number beyond the critical point.
double saturation_pressure(double temperature);
double saturated_water_density(double temperature);
double saturated_vapour_density(double temperature);

// dp/dT of saturation_pressure(), Pa/K, and d rho_l/dT of saturated_water_density(), kg/(m^3 K).
double saturation_pressure_slope(double temperature);
double saturated_water_density_slope(double temperature);

// Latent heat of evaporation, J/kg, by the equation of Clausius and Clapeyron:
//   L = T (1/rho_v - 1/rho_l) dp/dT
double latent_heat(double temperature);

// Temperature at which water has this saturation pressure, K: the dew point of a gas in which it is the partial
// pressure of vapour, or the boiling point at that pressure. pressure: Pa, above 0 and below p_c.
double saturation_temperature(double pressure);

}  // namespace crumble::dryer
