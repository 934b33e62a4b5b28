// The laws of the gas around a droplet, each against tables, limits or another law.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dryer/gas/film.hpp"
#include "dryer/gas/small_droplet.hpp"
#include "dryer/gas/water_saturation.hpp"
#include "dryer/water_surface_tension.hpp"

using namespace crumble::dryer;

namespace {

constexpr double pi = std::numbers::pi, ice = 273.15, atmosphere = 101325;
constexpr SmallDroplet large{false, false};

// IAPWS SR1-86, table of values for checking programs.
TEST(WaterSaturation, has_the_values_of_the_release) {
  struct Row {
    double T, p, water, vapour;
  };
  for (const Row& r : {Row{273.16, 611.657, 999.789, 0.00485426}, {373.1243, 101325, 958.365, 0.597586}}) {
    EXPECT_NEAR(saturation_pressure(r.T), r.p, 1e-6 * r.p);
    EXPECT_NEAR(saturated_water_density(r.T), r.water, 1e-6 * r.water);
    EXPECT_NEAR(saturated_vapour_density(r.T), r.vapour, 2e-6 * r.vapour);
    EXPECT_NEAR(saturation_temperature(r.p), r.T, 1e-4);
  }
  EXPECT_NEAR(latent_heat(273.16), 2500.5e3, 0.1e3);
  EXPECT_NEAR(latent_heat(373.1243), 2675.7e3 - 419.05e3, 0.2e3);
}

TEST(WaterSaturation, slopes_are_those_of_its_curves) {
  for (const double T : {280.0, 330.0, 400.0, 500.0}) {
    const double d = 1e-3;  // error of the difference: third derivatives times d^2
    EXPECT_NEAR(saturation_pressure_slope(T), (saturation_pressure(T + d) - saturation_pressure(T - d)) / (2 * d),
                1e-7 * saturation_pressure_slope(T));
    EXPECT_NEAR(saturated_water_density_slope(T),
                (saturated_water_density(T + d) - saturated_water_density(T - d)) / (2 * d), 1e-7);
    EXPECT_NEAR(saturation_temperature(saturation_pressure(T)), T, 1e-10);
  }
}

// IAPWS R15-11, Table 4, at zero density; R12-08, Table 4, at 1 kg/m^3 (a correction of 0.2 % at most); heat capacity
// of the ideal gas in the NIST WebBook, 33.59 J/(mol K).
TEST(VapourProperties, have_the_values_of_the_releases) {
  EXPECT_NEAR(vapour_conductivity(298.15), 18.4341883e-3, 1e-10);
  EXPECT_NEAR(vapour_viscosity(873.15), 32.619165e-6, 3e-3 * 32.6e-6);
  EXPECT_NEAR(vapour_heat_capacity(298.15), 33.59 / 18.015e-3, 1e-3 * 1864);
}

// Incropera & DeWitt, Table A.4: three digits; the laws are within 1 %.
TEST(AirProperties, agree_with_tables) {
  struct Row {
    double T, viscosity, conductivity, heat_capacity;
  };
  for (const Row& r : {Row{300, 184.6e-7, 26.3e-3, 1007}, {400, 230.1e-7, 33.8e-3, 1014}}) {
    EXPECT_NEAR(air_viscosity(r.T), r.viscosity, 0.01 * r.viscosity);
    EXPECT_NEAR(air_conductivity(r.T), r.conductivity, 0.01 * r.conductivity);
    EXPECT_NEAR(air_heat_capacity(r.T), r.heat_capacity, 0.002 * r.heat_capacity);
  }
}

// Fuller, Schettler & Giddings (1966) with 20.1 and 12.7: another way to the same number.
TEST(VapourDiffusivity, is_within_six_percent_of_another_law_and_goes_as_one_over_the_pressure) {
  for (const double T : {283.0, 300.0, 325.0, 350.0}) {
    const double volumes = std::cbrt(20.1) + std::cbrt(12.7);
    const double fuller = 1e-7 * std::pow(T, 1.75) * std::sqrt(1 / 28.97 + 1 / 18.015) / (volumes * volumes);
    EXPECT_NEAR(vapour_diffusivity(T, atmosphere), fuller, 0.06 * fuller) << T;
    EXPECT_NEAR(vapour_diffusivity(T, 2 * atmosphere), 0.5 * vapour_diffusivity(T, atmosphere), 1e-20);
  }
}

TEST(MoistAir, is_air_without_vapour_and_vapour_without_air) {
  const double T = 330;
  const MoistAir dry = moist_air(T, atmosphere, 0), steam = moist_air(T, atmosphere, 1);
  EXPECT_DOUBLE_EQ(dry.viscosity, air_viscosity(T));
  EXPECT_DOUBLE_EQ(dry.conductivity, air_conductivity(T));
  EXPECT_DOUBLE_EQ(dry.heat_capacity, air_heat_capacity(T));
  EXPECT_DOUBLE_EQ(steam.viscosity, vapour_viscosity(T));
  EXPECT_DOUBLE_EQ(steam.conductivity, vapour_conductivity(T));
  EXPECT_NEAR(dry.density, atmosphere * air_molar_mass / (gas_constant * T), 1e-15);
  EXPECT_NEAR(vapour_mass_fraction(vapour_mole_fraction(0.2)), 0.2, 1e-15);
}

// A film with properties of its own, not those of air.
MoistAir film_with(double heat_capacity, double lewis) {
  MoistAir film{1.1, 1.9e-5, 0.027, heat_capacity, heat_capacity, 0};
  film.diffusivity = film.conductivity / (film.density * heat_capacity * lewis);
  return film;
}

// k -> 2 D (rho_vs - rho_vinf)/rho_l; the next term is B/2 of it.
TEST(StefanFilm, is_maxwells_where_little_vapour_leaves) {
  const MoistAir film = film_with(1010, 0.9);
  const double R = 1e-5, Y = 0.01;
  for (const double B : {1e-4, 1e-7}) {
    const double Y_s = Y + B * (1 - Y);
    const Film f = stefan_film(film, R, Y_s, 300, {310, Y, 0});
    const double maxwell = 4 * pi * R * film.diffusivity * film.density * (Y_s - Y) / (1 - Y);
    EXPECT_NEAR(f.evaporation / maxwell, 1, B);
  }
}

// B_M = B_T: c_p (T_inf - T_s)/L = (Y_s - Y_inf)/(1 - Y_s), the adiabatic saturation of the gas.
TEST(StefanFilm, at_lewis_number_one_and_one_heat_capacity_ends_in_adiabatic_saturation) {
  const double c = 1200, L = 2.4e6, Y_s = 0.06, Y = 0.01, T_s = 310, R = 2e-5;
  const double T = T_s + L / c * (Y_s - Y) / (1 - Y_s);
  for (const double slip : {0.0, 3.0}) {
    const Film f = stefan_film(film_with(c, 1), R, Y_s, T_s, {T, Y, slip});
    EXPECT_NEAR(f.heat / (L * f.evaporation), 1, 1e-12) << slip;
    EXPECT_NEAR(f.sherwood, f.nusselt, 1e-12);
  }
}

TEST(StefanFilm, without_slip_has_sherwood_number_two_and_with_slip_that_of_froessling) {
  const MoistAir film = film_with(1010, 0.9);
  const Gas still{300, 0.01, 0}, wind{300, 0.01, 2};
  EXPECT_EQ(stefan_film(film, 1e-5, 0.02, 300, still).sherwood, 2);
  EXPECT_EQ(stefan_film(film, 1e-5, 0.02, 300, still).nusselt, 2);
  // B -> 0: F = 1.
  const double R = 5e-5, Re = 2 * R * film.density * 2 / film.viscosity;
  const double Sc = film.viscosity / film.density / film.diffusivity;
  const Film f = stefan_film(film, R, 0.01 + 1e-9, 300, wind);
  EXPECT_NEAR(f.sherwood, 2 + 0.552 * std::sqrt(Re) * std::cbrt(Sc), 1e-8);
  EXPECT_NEAR(f.nusselt, 2 + 0.552 * std::sqrt(Re) * std::cbrt(film.viscosity * film.heat_capacity / film.conductivity),
              1e-7);
  // Thicker films of faster evaporation: Sh falls; at B = 1, F = 2^0.7 ln 2 = 1.126.
  const Film fast = stefan_film(film, R, 0.505, 300, wind);
  EXPECT_NEAR(fast.mass_transfer_number, 1, 1e-12);
  EXPECT_NEAR((fast.sherwood - 2) * std::pow(2, 0.7) * std::log(2.0), 0.552 * std::sqrt(Re) * std::cbrt(Sc), 1e-12);
}

// exp(-x) of the heat is used up by the vapour that flows against it; where vapour condenses the heat is more.
TEST(StefanFilm, lets_vapour_condense_with_the_sign_turned_round) {
  const Film f = stefan_film(film_with(1010, 0.9), 1e-5, 0.01, 280, {300, 0.05, 0});
  EXPECT_LT(f.evaporation, 0);
  EXPECT_GT(f.heat, 4 * pi * 1e-5 * 0.027 * 20);
}

// Saturated gas: nothing evaporates, and the droplet is as warm as the gas.
TEST(WetBulb, of_saturated_gas_is_its_temperature) {
  for (const double T : {283.0, 310.0, 350.0}) {
    const Gas gas{T, mass_fraction_at(saturation_pressure(T), atmosphere), 0};
    EXPECT_NEAR(wet_bulb(1e-5, gas, large), T, 1e-9);
    const double free = 2e-9;  // k of dry gas is of this size
    EXPECT_NEAR(evaporation_constant(film_of(1e-5, T, gas, large), 1e-5, T), 0, 1e-12 * free);
    EXPECT_NEAR(relative_humidity(gas), 1, 1e-12);
    EXPECT_NEAR(dew_point(gas), T, 1e-9);
  }
}

// Three gases worked out apart, with fits of properties good to some 3 %.
TEST(WetBulb, and_evaporation_constant_of_three_gases) {
  struct Row {
    Gas gas;
    double wet_bulb, k;
  };
  const double room = ice + 25;
  for (const Row& r : {Row{{room, mass_fraction_at(0.5 * saturation_pressure(room), atmosphere), 0}, 17.6, 1.57e-10},
                       Row{{room, 0, 0}, 7.3, 3.6e-10}, Row{{ice + 150, 0.01, 0}, 41, 2.6e-9}}) {
    const double R = 25e-6, T = wet_bulb(R, r.gas, large);
    EXPECT_NEAR(T - ice, r.wet_bulb, 0.03 * r.wet_bulb);
    EXPECT_NEAR(evaporation_constant(film_of(R, T, r.gas, large), R, T), r.k, 0.03 * r.k);
  }
}

TEST(WetBulb, below_the_triple_point_is_refused) { EXPECT_THROW(wet_bulb(1e-5, {280, 0, 0}), std::domain_error); }

TEST(Kelvin, raises_the_vapour_pressure_by_one_nanometre_over_the_radius) {
  const double T = 298.15, sigma = water_surface_tension(T), rho = saturated_water_density(T);
  EXPECT_NEAR(std::log(kelvin_factor(sigma, rho, T, 100e-9)) * 100, 1.05, 0.01);
  EXPECT_NEAR(kelvin_factor(sigma, rho, T, 1e-3), 1, 2e-6);
  // A small droplet evaporates into saturated gas.
  const Gas gas{T, mass_fraction_at(saturation_pressure(T), atmosphere), 0};
  EXPECT_GT(film_of(1e-7, T, gas).evaporation, 0);
}

TEST(FuchsSutugin, is_one_in_the_continuum_and_the_flux_of_free_molecules_far_from_it) {
  EXPECT_EQ(fuchs_sutugin(0), 1);
  EXPECT_NEAR(fuchs_sutugin(1), 2 / 4.0437, 1e-3);
  const double T = 300, D = 2.5e-5, R = 1e-12, c = std::sqrt(8 * water_gas_constant * T / pi);
  // 4 pi R D beta = pi R^2 c; the next term is of order 1/Kn.
  EXPECT_NEAR(4 * D * fuchs_sutugin(vapour_free_path(D, T) / R) / (R * c), 1, 1e-4);
  const double k = 0.026, p = atmosphere, M = air_molar_mass, g = 1.4, c_a = std::sqrt(8 * gas_constant * T / (pi * M));
  EXPECT_NEAR(4 * k * fuchs_sutugin(heat_free_path(k, T, p, M, g) / R) / (R * p * c_a / (2 * T) * (g + 1) / (g - 1)), 1,
              1e-4);
}

TEST(SmallDroplet, is_no_other_than_a_large_one_where_it_is_large) {
  const Gas gas{423.15, 0.01, 0};
  const double T = 313, R = 1e-3;
  EXPECT_NEAR(film_of(R, T, gas).evaporation / film_of(R, T, gas, large).evaporation, 1, 3e-4);
  EXPECT_LT(film_of(1e-7, T, gas).evaporation, 0.6 * film_of(1e-7, T, gas, large).evaporation);
}

}  // namespace
