#include "dryer/gas/moist_air.hpp"

#include <cmath>

#include "dryer/gas/water_saturation.hpp"
#include "dryer/water_surface_tension.hpp"

namespace crumble::dryer {

namespace {

double cube(double x) { return x * x * x; }

// Heat capacity of a harmonic oscillator over R; u = theta/T.
double oscillator(double u) {
  const double x = 0.5 * u / std::sinh(0.5 * u);
  return x * x;
}

// Wilke's factor of species 1 among species 2, from the ratios of viscosities and molar masses.
double wilke(double viscosity_ratio, double mass_ratio) {
  const double x = 1 + std::sqrt(viscosity_ratio) * std::pow(mass_ratio, -0.25);
  return x * x / std::sqrt(8 * (1 + mass_ratio));
}

}  // namespace

double air_viscosity(double T) { return 1.458e-6 * std::sqrt(cube(T)) / (T + 110.4); }

double air_conductivity(double T) { return 2.64638e-3 * std::sqrt(cube(T)) / (T + 245.4 * std::pow(10.0, -12 / T)); }

double air_heat_capacity(double T) {
  return gas_constant / air_molar_mass * (3.5 + 0.781 * oscillator(3393 / T) + 0.209 * oscillator(2273 / T));
}

double vapour_viscosity(double T) {
  const double t = T / water_critical_temperature;
  return 1e-4 * std::sqrt(t) / (1.67752 + (2.20462 + (0.6366564 - 0.241605 / t) / t) / t);
}

double vapour_conductivity(double T) {
  const double t = T / water_critical_temperature;
  return 1e-3 * std::sqrt(t) /
         (2.443221e-3 + (1.323095e-2 + (6.770357e-3 + (-3.454586e-3 + 4.096266e-4 / t) / t) / t) / t);
}

double vapour_heat_capacity(double T) {
  constexpr double n[]{0.012436, 0.97315, 1.27950, 0.96956, 0.24873};
  constexpr double gamma[]{1.28728967, 3.53734222, 7.74073708, 9.24437796, 27.5075105};
  double over_R = 4.00632;
  for (int k = 0; k < 5; ++k) over_R += n[k] * oscillator(gamma[k] * water_critical_temperature / T);
  return water_gas_constant * over_R;
}

double vapour_diffusivity(double T, double pressure) { return 1.87e-10 * std::pow(T, 2.072) / (pressure / 101325); }

double vapour_mole_fraction(double Y) {
  const double vapour = Y / water_molar_mass;
  return vapour / (vapour + (1 - Y) / air_molar_mass);
}

double vapour_mass_fraction(double x) {
  return x * water_molar_mass / (x * water_molar_mass + (1 - x) * air_molar_mass);
}

MoistAir moist_air(double T, double pressure, double Y) {
  const double x = vapour_mole_fraction(Y), mu_v = vapour_viscosity(T), mu_a = air_viscosity(T);
  const double M = x * water_molar_mass + (1 - x) * air_molar_mass, masses = water_molar_mass / air_molar_mass;
  const double vapour = x / (x + (1 - x) * wilke(mu_v / mu_a, masses));
  const double air = (1 - x) / ((1 - x) + x * wilke(mu_a / mu_v, 1 / masses));
  MoistAir gas;
  gas.density = pressure * M / (gas_constant * T);
  gas.viscosity = vapour * mu_v + air * mu_a;
  gas.conductivity = vapour * vapour_conductivity(T) + air * air_conductivity(T);
  gas.vapour_heat_capacity = vapour_heat_capacity(T);
  gas.heat_capacity = Y * gas.vapour_heat_capacity + (1 - Y) * air_heat_capacity(T);
  gas.diffusivity = vapour_diffusivity(T, pressure);
  return gas;
}

}  // namespace crumble::dryer
