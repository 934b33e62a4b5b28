// Air and water vapour: the properties of each at low density, and of their mixture.
#pragma once

namespace crumble::dryer {

inline constexpr double air_molar_mass = 28.9647e-3;  // dry air, kg/mol (US Standard Atmosphere 1976: 28.9644)

// Viscosity, Pa s, of dry air:  1.458e-6 T^1.5/(T + 110.4)
// Sutherland (1893), Phil. Mag. 36, 507; constants of the US Standard Atmosphere 1976. T in K.
double air_viscosity(double temperature);
// Conductivity, W/(m K), of dry air:  2.64638e-3 T^1.5/(T + 245.4 10^(-12/T))
// US Standard Atmosphere 1976, Eq. 53.
double air_conductivity(double temperature);
// Heat capacity at constant pressure, J/(kg K), of dry air: (7/2) R and the vibrations of nitrogen (78.1 %) and oxygen
// (20.9 %) as harmonic oscillators of 3393 and 2273 K, (u/2)^2/sinh^2(u/2) R with u = theta/T. Frequencies: Herzberg
// (1950), Spectra of Diatomic Molecules.
double air_heat_capacity(double temperature);

// Of water vapour at low density, T in K; with t = T/647.096:
// viscosity, Pa s:         1e-4 sqrt(t)/(H0 + H1/t + H2/t^2 + H3/t^3)                   IAPWS R12-08, Eq. 11
double vapour_viscosity(double temperature);
// conductivity, W/(m K):   1e-3 sqrt(t)/(L0 + L1/t + ... + L4/t^4)                       IAPWS R15-11, Eq. 16
double vapour_conductivity(double temperature);
// heat capacity at constant pressure, J/(kg K): ideal-gas part of IAPWS R6-95; Wagner & Pruss (2002), J. Phys. Chem.
// Ref. Data 31, 387:       R_v (4.00632 + sum of n u^2 e^-u/(1 - e^-u)^2), u = gamma/t
double vapour_heat_capacity(double temperature);

// Diffusivity of water vapour in air, m^2/s:
//   D_v = 1.87e-10 (T/K)^2.072/(p/101325 Pa)
// Marrero & Mason (1972), J. Phys. Chem. Ref. Data 1, 3: 282 to 450 K. Others that are in use: Massman (1998), Atmos.
// Environ. 32, 1111, 2 % more at 300 K and 2 % less at 350 K; Fuller, Schettler & Giddings (1966), 5 % less at 350 K.
// Pressure in Pa.
double vapour_diffusivity(double temperature, double pressure);

// The mixture at a mass fraction Y of vapour, ideal gases.
struct MoistAir {
  double density = 0;               // rho_g, kg/m^3
  double viscosity = 0;             // mu_g, Pa s
  double conductivity = 0;          // k_g, W/(m K)
  double heat_capacity = 0;         // c_p of the mixture, J/(kg K)
  double vapour_heat_capacity = 0;  // c_pv, J/(kg K)
  double diffusivity = 0;           // D_v, m^2/s
};
// Viscosity: Wilke (1950), J. Chem. Phys. 18, 517; conductivity: Wassiljewa (1904) with the same factors, Mason &
// Saxena (1958), Phys. Fluids 1, 361; heat capacity by mass.
MoistAir moist_air(double temperature, double pressure, double vapour_mass_fraction);

// Mole fraction of vapour at a mass fraction Y, and the other way round.
double vapour_mole_fraction(double mass_fraction);
double vapour_mass_fraction(double mole_fraction);

}  // namespace crumble::dryer
