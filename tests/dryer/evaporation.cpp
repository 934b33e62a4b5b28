// R(t) and T(t) of a droplet in a gas: limits, balances, order, and the curve that the dryer follows.
#include "dryer/gas/evaporation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dryer/gas/water_saturation.hpp"
#include "dryer/liquid_course.hpp"

using namespace crumble::dryer;

namespace {

constexpr SmallDroplet large{false, false};
const Gas hot{423.15, 0.01, 0};

double mass(const DryingCurve::Node& n) {
  return saturated_water_density(n.temperature) * 4.0 / 3 * std::numbers::pi * std::pow(n.square, 1.5);
}

TEST(Evaporation, at_the_wet_bulb_has_a_straight_square_to_rounding) {
  const double R = 25e-6, T = wet_bulb(R, hot, large), k = evaporation_constant(film_of(R, T, hot, large), R, T);
  const Evaporation e = evaporation({R, T, 25e-9, large}, GasHistory(hot));
  EXPECT_NEAR(e.curve.lifetime(), R * R / k, 1e-10 * R * R / k);
  for (const double theta : {0.1, 0.3, 0.5, 0.9, 0.999}) {
    const double t = theta * e.curve.lifetime();
    EXPECT_NEAR(std::pow(e.curve.radius(t), 2), R * R - k * t, 1e-11 * R * R) << theta;
    EXPECT_NEAR(e.curve.temperature(t), T, 1e-8);
  }
}

// A cold droplet, a history and all corrections at once.
TEST(Evaporation, closes_the_balances_of_water_and_of_heat) {
  const GasHistory history({0, 0.01, 0.05}, {hot, {390, 0.03, 1}, {360, 0.05, 0}});
  for (const double R : {2e-7, 25e-6}) {
    const Evaporation e = evaporation({R, 288.15, 0.05 * R, {}}, history, 1e-12);
    const auto &first = e.curve.nodes().front(), &last = e.curve.nodes()[e.nodes_to_last_radius - 1];
    EXPECT_NEAR((mass(first) - mass(last) - e.evaporated) / mass(first), 0, 1e-10) << R;
    const double enthalpy = water_heat_capacity * (mass(last) * last.temperature - mass(first) * first.temperature);
    EXPECT_NEAR((enthalpy - e.enthalpy) / (mass(first) * latent_heat(300)), 0, 1e-10) << R;
  }
}

// Errors below the tolerance times the number of steps, and that is what a tighter tolerance leaves.
TEST(Evaporation, converges_with_its_tolerance) {
  const EvaporatingDroplet cold{25e-6, 288.15, 25e-9, {}};
  const double exact = evaporation(cold, GasHistory(hot), 1e-12).curve.lifetime();
  for (const double tolerance : {1e-5, 1e-7, 1e-9})
    EXPECT_NEAR(evaporation(cold, GasHistory(hot), tolerance).curve.lifetime(), exact, 1000 * tolerance * exact);
}

// Without evaporation (saturated gas at the droplet's own temperature) a slightly colder droplet relaxes to it in the
// time rho c R^2/(3 k_g), shortened by the heat of the vapour that condenses: (1 + L dY_s/dT rho D/k) times as fast.
TEST(Evaporation, warms_up_in_the_heat_up_time) {
  const double R = 1e-4, T = 300;
  // Just below saturation, where `evaporation` accepts a gas: the droplet lives long against this time.
  const Gas gas{T, mass_fraction_at(saturation_pressure(T), 101325) * 0.9999, 0};
  const double settled = wet_bulb(R, gas, large), start = settled - 0.01;
  const Evaporation e = evaporation({R, start, 1e-6, large}, GasHistory(gas));
  const MoistAir film = moist_air(T, 101325, gas.vapour_mass_fraction);
  const double step = 1e-3;
  const double Y_slope = (mass_fraction_at(saturation_pressure(T + step), 101325) -
                          mass_fraction_at(saturation_pressure(T - step), 101325)) /
                         (2 * step);
  const double faster = 1 + latent_heat(T) * film.density * film.diffusivity * Y_slope /
                                ((1 - gas.vapour_mass_fraction) * film.conductivity);
  const double relaxation = heat_up_time(R, T, film.conductivity) / faster;
  EXPECT_GT(faster, 2);
  EXPECT_NEAR((settled - e.curve.temperature(relaxation)) / 0.01, std::exp(-1), 0.005);
}

TEST(Evaporation, lets_vapour_condense_on_a_cold_droplet_before_it_dries) {
  const double R = 25e-6;
  const Evaporation e = evaporation({R, 280, 25e-9, {}}, GasHistory(Gas{330, 0.05, 0}));
  const double largest = e.curve.radius(e.curve.time_at(2 * R));
  EXPECT_GT(largest, 1.01 * R);
  EXPECT_LT(largest, 1.05 * R);
  // The last instant with the radius of the start, not the first.
  EXPECT_GT(e.curve.time_at(R), e.curve.time_at(2 * R));
  EXPECT_NEAR(e.curve.radius(e.curve.time_at(R)), R, 1e-12 * R);
}

TEST(Evaporation, says_what_happens_to_a_droplet_that_does_not_dry) {
  const auto complaint = [](const EvaporatingDroplet& droplet, const Gas& gas) {
    try {
      evaporation(droplet, GasHistory(gas));
    } catch (const std::domain_error& error) {
      return std::string(error.what());
    }
    return std::string("dries");
  };
  const Gas full{300, mass_fraction_at(saturation_pressure(300), 101325), 0};
  EXPECT_NE(complaint({25e-6, 300, 25e-9, {}}, full).find("saturated"), std::string::npos);
  EXPECT_NE(complaint({25e-6, 290, 25e-9, {}}, {280, 0, 0}).find("freezes"), std::string::npos);
  EXPECT_NE(complaint({25e-6, 380, 25e-9, {}}, hot).find("boils"), std::string::npos);
  EXPECT_EQ(complaint({25e-6, 300, 25e-9, {}}, hot), "dries");
}

TEST(GasHistory, is_linear_between_its_instants_and_stays_after_them) {
  const GasHistory history({0, 1, 3}, {{300, 0.01, 0}, {400, 0.03, 2}, {350, 0.03, 0}});
  EXPECT_DOUBLE_EQ(history.at(0.5).temperature, 350);
  EXPECT_DOUBLE_EQ(history.at(0.5).vapour_mass_fraction, 0.02);
  EXPECT_DOUBLE_EQ(history.at(2).slip, 1);
  EXPECT_DOUBLE_EQ(history.at(9).temperature, 350);
}

TEST(DryingCurve, inverts_itself_and_knows_its_speed) {
  const DryingCurve curve = evaporation({1e-6, 290, 1e-8, {}}, GasHistory(hot)).curve;
  for (const double R : {0.9e-6, 0.5e-6, 0.1e-6, 1.1e-8, 0.5e-8}) {
    const double t = curve.time_at(R), d = 1e-5 * (curve.lifetime() - t);
    EXPECT_NEAR(curve.radius(t), R, 1e-9 * R);
    EXPECT_NEAR(curve.front_speed(R), (curve.radius(t - d) - curve.radius(t + d)) / (2 * d),
                1e-5 * curve.front_speed(R));
  }
  EXPECT_EQ(curve.radius(curve.lifetime()), 0);
  EXPECT_EQ(curve.time_at(0), curve.lifetime());
}

TEST(DryingCurve, of_a_smaller_droplet_has_the_same_evaporation_constant) {
  const DryingCurve real = evaporation({1e-5, 290, 1e-8, {}}, GasHistory(hot)).curve, small = real.scaled(0.1, 0.01);
  EXPECT_NEAR(small.lifetime(), 0.01 * real.lifetime(), 1e-15);
  for (const double theta : {0.01, 0.5, 0.99}) {
    EXPECT_NEAR(small.radius(theta * small.lifetime()), 0.1 * real.radius(theta * real.lifetime()), 1e-15);
    EXPECT_NEAR(small.temperature(theta * small.lifetime()), real.temperature(theta * real.lifetime()), 1e-9);
  }
  EXPECT_NEAR(2e-7 * small.front_speed(2e-7), 2e-6 * real.front_speed(2e-6), 1e-9 * 2e-6 * real.front_speed(2e-6));
}

TEST(LiquidCourse, keeps_its_pieces_within_a_quarter_of_a_kelvin) {
  const DryingCurve curve = evaporation({25e-6, 288.15, 25e-9, {}}, GasHistory(hot)).curve;
  const auto pieces = liquid_course(curve, [](LiquidPiece& piece) { piece.viscosity = piece.temperature; });
  EXPECT_GT(pieces.size(), 40u);  // from 15 to 40 C
  for (int k = 0; k <= 10000; ++k) {
    const double t = k * 1e-4 * curve.lifetime();
    ASSERT_NEAR(piece_at(pieces, t).temperature, curve.temperature(t), 0.26) << k;
    EXPECT_EQ(piece_at(pieces, t).viscosity, piece_at(pieces, t).temperature);
  }
  EXPECT_EQ(pieces_passed(pieces, 3, 1e9), pieces.size() - 4);
}

}  // namespace
