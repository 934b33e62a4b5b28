// The gas film around a droplet: how fast vapour leaves and heat arrives.
#pragma once

#include "dryer/gas/moist_air.hpp"

namespace crumble::dryer {

// The gas far from the droplet.
struct Gas {
  double temperature = 0;           // T_inf, K
  double vapour_mass_fraction = 0;  // Y_inf, kg of vapour per kg of gas
  double slip = 0;                  // speed of the droplet against the gas, m/s
  double pressure = 101325;         // p, Pa
};

// A film is quasi-steady and has the properties of the gas at a third of the way from the surface (Hubbard, Denny &
// Mills 1975).
struct Film {
  double mass_transfer_number = 0;  // B_M = (Y_s - Y_inf)/(1 - Y_s)
  double evaporation = 0;           // mass that leaves, kg/s; below 0 where vapour condenses
  double heat = 0;                  // that reaches the surface from the gas, W
  double sherwood = 2, nusselt = 2;
};

// Stefan flow through a film, with the correction for its thickness where the droplet slips:
//   dm/dt = -2 pi R rho_g D_v Sh ln(1 + B_M)
//   Q = 2 pi R k_g Nu (T_inf - T_s) x/(e^x - 1),   x = |dm/dt| c_pv/(2 pi R k_g Nu) = ln(1 + B_T)
//   Sh = 2 + (Sh0 - 2)/F(B_M),  Nu = 2 + (Nu0 - 2)/F(B_T),  F(B) = (1 + B)^0.7 ln(1 + B)/B
//   Sh0 = 2 + 0.552 Re^(1/2) Sc^(1/3),  Nu0 = 2 + 0.552 Re^(1/2) Pr^(1/3),  Re = 2 R rho_g slip/mu_g
// Abramzon & Sirignano (1989), Int. J. Heat Mass Transfer 32, 1605; without slip Spalding's law. Their Re has the
// density of the free gas; here it is the film's, which Sc and Pr have. R: m; Y_s: mass fraction of vapour at the
// surface, below 1; SI. Sign: evaporation and heat to the droplet are positive.
Film stefan_film(const MoistAir& film, double R, double surface_mass_fraction, double surface_temperature,
                 const Gas& gas);

// Which corrections of small_droplet.hpp hold; both tend to nothing in a large droplet.
struct SmallDroplet {
  bool kelvin = true, knudsen = true;
};

// The film of a water droplet of radius R at temperature T_s, all properties from the laws of this folder. Not a
// number where the water boils.
Film film_of(double R, double temperature, const Gas& gas, const SmallDroplet& small = {});

// Evaporation constant k = -dR^2/dt = |dm/dt|/(2 pi R rho_l), m^2/s.
double evaporation_constant(const Film& film, double R, double temperature);

// Temperature at which a water droplet of radius R neither warms nor cools: Q = L |dm/dt|. Throws std::domain_error
// saying so if that would be below the triple point.
double wet_bulb(double R, const Gas& gas, const SmallDroplet& small = {});

// Humidity in other words. Of vapour, mass fraction from the partial pressure (Pa) and back.
double mass_fraction_at(double vapour_pressure, double pressure);
double vapour_pressure(const Gas& gas);
double relative_humidity(const Gas& gas);  // over liquid water
double dew_point(const Gas& gas);          // K; 0 of dry gas

}  // namespace crumble::dryer
