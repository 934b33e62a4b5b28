#include "dryer/gas/film.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "dryer/gas/small_droplet.hpp"
#include "dryer/gas/water_saturation.hpp"
#include "dryer/water_surface_tension.hpp"

namespace crumble::dryer {

namespace {

// F(B) from x = ln(1 + B): (1 + B)^0.7 x/B, 1 at B = 0.
double thickening(double x) { return std::abs(x) < 1e-12 ? 1 : std::exp(0.7 * x) * x / std::expm1(x); }

// x/(e^x - 1), 1 at x = 0.
double shielding(double x) { return std::abs(x) < 1e-12 ? 1 - x / 2 : x / std::expm1(x); }

}  // namespace

Film stefan_film(const MoistAir& film, double R, double Y_s, double T_s, const Gas& gas) {
  constexpr double pi = std::numbers::pi;
  Film f;
  f.mass_transfer_number = (Y_s - gas.vapour_mass_fraction) / (1 - Y_s);
  const double x_M = std::log1p(f.mass_transfer_number);
  const double Re = 2 * R * film.density * gas.slip / film.viscosity;
  const double Sc = film.viscosity / (film.density * film.diffusivity);
  const double Pr = film.viscosity * film.heat_capacity / film.conductivity;
  f.sherwood = 2 + 0.552 * std::sqrt(Re) * std::cbrt(Sc) / thickening(x_M);
  f.evaporation = 2 * pi * R * film.density * film.diffusivity * f.sherwood * x_M;
  const double flow = f.evaporation * film.vapour_heat_capacity / (2 * pi * R * film.conductivity);
  const double convection = 0.552 * std::sqrt(Re) * std::cbrt(Pr);
  f.nusselt = 2 + convection;
  // Nu and B_T depend on each other: a contraction, since F lies between 1 and some 1.3.
  for (int k = 0; k < 100 && convection > 0; ++k) {
    const double next = 2 + convection / thickening(flow / f.nusselt);
    const bool settled = std::abs(next - f.nusselt) < 1e-15 * next;
    f.nusselt = next;
    if (settled) break;
  }
  f.heat = 2 * pi * R * film.conductivity * f.nusselt * (gas.temperature - T_s) * shielding(flow / f.nusselt);
  return f;
}

Film film_of(double R, double T, const Gas& gas, const SmallDroplet& small) {
  double p = saturation_pressure(T);
  if (small.kelvin && T < water_critical_temperature)
    p *= kelvin_factor(water_surface_tension(T), saturated_water_density(T), T, R);
  if (!(p < gas.pressure)) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none, none, none};
  }
  const double Y_s = mass_fraction_at(p, gas.pressure);
  const double T_film = T + (gas.temperature - T) / 3, Y_film = Y_s + (gas.vapour_mass_fraction - Y_s) / 3;
  MoistAir film = moist_air(T_film, gas.pressure, Y_film);
  if (small.knudsen) {
    const double x = vapour_mole_fraction(Y_film), M = x * water_molar_mass + (1 - x) * air_molar_mass;
    const double g = 1 / (1 - gas_constant / (M * film.heat_capacity));
    film.conductivity *= fuchs_sutugin(heat_free_path(film.conductivity, T_film, gas.pressure, M, g) / R);
    film.diffusivity *= fuchs_sutugin(vapour_free_path(film.diffusivity, T_film) / R);
  }
  return stefan_film(film, R, Y_s, T, gas);
}

double evaporation_constant(const Film& film, double R, double T) {
  return film.evaporation / (2 * std::numbers::pi * R * saturated_water_density(T));
}

double wet_bulb(double R, const Gas& gas, const SmallDroplet& small) {
  // Heat in excess: falls with the temperature; where the water would boil it is not a number, as if far below zero.
  const auto warms = [&](double T) {
    const Film f = film_of(R, T, gas, small);
    return f.heat - latent_heat(T) * f.evaporation > 0;
  };
  double low = water_triple_point, high = gas.temperature;
  if (high <= low || (!warms(low) && relative_humidity(gas) < 1))
    throw std::domain_error(
        fmt::format("in a gas of {:.2f} K a droplet would come below {} K and freeze, which is not known here",
                    gas.temperature, water_triple_point));
  high = std::fmin(high, saturation_temperature(gas.pressure));
  // A droplet in saturated gas may be as warm as the gas, and the small one slightly warmer: then high itself.
  if (warms(high)) return high;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (warms(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double mass_fraction_at(double vapour_pressure, double pressure) {
  return vapour_mass_fraction(vapour_pressure / pressure);
}

double vapour_pressure(const Gas& gas) { return vapour_mole_fraction(gas.vapour_mass_fraction) * gas.pressure; }

double relative_humidity(const Gas& gas) {
  return gas.temperature < water_critical_temperature ? vapour_pressure(gas) / saturation_pressure(gas.temperature) : 0;
}

double dew_point(const Gas& gas) {
  return gas.vapour_mass_fraction > 0 ? saturation_temperature(vapour_pressure(gas)) : 0;
}

}  // namespace crumble::dryer
