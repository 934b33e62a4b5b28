#include "common/surface_forces/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/surface_forces/passage.hpp"
#include "tests/surface_forces/systems.hpp"

using namespace crumble;
using namespace crumble::systems;

namespace {

struct Row {
  const char* name;
  double a, hamaker, potential, ionic_strength, kappa_a;
  double barrier, at, largest_force;  // kT, m, N
  double lubricated, free_draining;   // W
};

// Without retardation. Numbers of the same equations computed elsewhere; they are printed with three digits, and W of a
// barrier of 122 kT turns a thousandth of it into 12 %.
class Table : public ::testing::TestWithParam<Row> {};

TEST_P(Table, barrier_force_and_stability_ratio) {
  const Row& row = GetParam();
  const Plain pair(forces(row.hamaker, row.potential, row.ionic_strength), row.a);
  EXPECT_NEAR(pair.repulsion.kappa * row.a / row.kappa_a, 1, 0.005);
  const auto top = barrier([&](double h) { return pair.in_kT(h); }, 1e-11, 1e-7);
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->value / row.barrier, 1, 0.003);
  EXPECT_NEAR(top->gap / row.at, 1, 0.01);
  double largest = 0;
  for (double h = top->gap; h < 1e-7; h *= 1.001) largest = std::max(largest, -pair.tension(h));
  EXPECT_NEAR(largest / row.largest_force, 1, 0.01);
  const auto energy = [&](double h) { return pair.in_kT(h); };
  const auto attraction = [&](double h) { return pair.attraction.energy(h) / kT; };
  const double room = row.barrier < 20 ? 0.01 : 0.15;
  EXPECT_NEAR(log_stability_ratio(energy, attraction, row.a, Drainage::lubricated), std::log(row.lubricated), room);
  EXPECT_NEAR(log_stability_ratio(energy, attraction, row.a, Drainage::free), std::log(row.free_draining), room);
}

INSTANTIATE_TEST_SUITE_P(
    , Table,
    ::testing::Values(Row{"silica", 10e-9, 4.6e-21, 0.03, 1, 1.04, 7.48, 0.80e-9, 3.6e-12, 532, 153},
                      Row{"salted_silica", 10e-9, 4.6e-21, 0.03, 100, 10.4, 4.10, 0.36e-9, 12.2e-12, 12.8, 2.79},
                      Row{"polystyrene", 100e-9, 9.5e-21, 0.04, 1, 10.4, 122, 1.12e-9, 42e-12, 7.2e51, 3.0e50}),
    [](const auto& row) { return row.param.name; });

TEST(Stability, without_charge_there_is_no_barrier_and_W_is_1) {
  const Plain pair(forces(4.6e-21, 0, 1), 10e-9);
  const auto energy = [&](double h) { return pair.in_kT(h); };
  EXPECT_FALSE(barrier(energy, 1e-11, 1e-7));
  EXPECT_FALSE(outer_minimum(energy, 1e-11, 1e-7));
  EXPECT_EQ(log_stability_ratio(energy, energy, 10e-9, Drainage::lubricated), 0);
}

// beta of two spheres: 1 far away, a/(2 h) near contact.
TEST(Stability, squeezing_resistance_has_its_limits) {
  EXPECT_NEAR(squeezing_resistance(1, 1e-9), 1, 1e-8);
  EXPECT_NEAR(squeezing_resistance(1e-15, 1e-8) / (1e-8 / 2e-15), 1, 1e-5);
}

// A square barrier of width w << a at contact in free draining: W = 1 + (w/(2 a)) (e^U - 1) to first order in w/a.
TEST(Stability, ratio_of_a_square_barrier_is_its_closed_form) {
  const double a = 10e-9, w = 1e-11, U = 8;
  const auto none = [](double) { return 0.0; };
  const auto square = [&](double h) { return h < w ? U : 0; };
  EXPECT_NEAR(
      std::exp(log_stability_ratio(square, none, a, Drainage::free)) / (1 + std::expm1(U) * (1 - 2 * a / (2 * a + w))),
      1, 2e-3);
}

TEST(Stability, critical_coagulation_concentration_is_where_the_barrier_vanishes) {
  EXPECT_NEAR(critical_coagulation_concentration(water(1), 0.04, 9.5e-21), 800, 10);
  // By the forms of the derivation (thin layers), barrier and slope vanish together there.
  const double ccc = critical_coagulation_concentration(water(1), 0.04, 9.5e-21), a = 1e-5;
  const auto top = [&](double share) {
    const Plain pair(forces(9.5e-21, 0.04, share * ccc), a);
    const auto found = barrier([&](double h) { return pair.in_kT(h); }, 1e-11, 1e-8);
    return found ? found->value : 0;
  };
  EXPECT_GT(top(0.97), 0);
  EXPECT_EQ(top(1.03), 0);
}

TEST(Stability, rapid_coagulation_half_time_of_nanoparticles) {
  EXPECT_NEAR(rapid_coagulation_half_time(1e-3, 10e-9, 0.01, kT), 76e-6, 0.5e-6);
}

// Particles of 300 nm whose outer minimum is 7 kT deep, 12 kT below the barrier, and the same energy twice and four
// times as high: Kramers' time is the first term of an expansion in 1/height.
TEST(SecondaryMinimum, lifetime_by_Kramers_is_the_limit_of_the_exact_integral) {
  const double a = 300e-9;
  const Plain pair(forces(9.5e-21, 0.02, 50), a);
  const double D = 2 * kT / (6 * std::numbers::pi * 1e-3 * a);
  double before = 1;
  for (const double times : {1.0, 2.0, 4.0}) {
    const auto energy = [&](double h) { return times * pair.in_kT(h); };
    const auto top = barrier(energy, 1e-10, 1e-7);
    ASSERT_TRUE(top);
    const auto well = outer_minimum(energy, top->gap, 1e-7);
    ASSERT_TRUE(well);
    EXPECT_NEAR(top->value - well->value, 12.1 * times, 0.3 * times);
    const auto curvature = [&](double h) {
      const double d = 1e-3 * h;
      return (energy(h + d) - 2 * energy(h) + energy(h - d)) / (d * d);
    };
    const double kramers = kramers_time(top->value - well->value, curvature(well->gap), curvature(top->gap), D);
    // A wall outside, where 2 kT of the well are left: the flat sea beyond would count as part of the well. Past the
    // top there is no way back once 4 kT of the other side lie behind.
    double wall = well->gap, far_side = top->gap;
    while (energy(wall) < -2) wall *= 1.01;
    while (energy(far_side) > top->value - 4) far_side *= 0.999;
    const double off = mean_first_passage(energy, wall, well->gap, far_side, D) / kramers - 1;
    EXPECT_GT(off, 0);
    EXPECT_LT(off, 0.6 * before) << times;
    before = off;
  }
  EXPECT_LT(before, 0.1);
}

// (L^2 - l^2)/(2 D) from l to L.
TEST(SecondaryMinimum, passage_over_a_flat_potential_takes_the_time_of_diffusion) {
  const auto flat = [](double) { return 0.0; };
  EXPECT_NEAR(mean_first_passage(flat, 0, 1e-9, 5e-9, 1e-12) / ((25 - 1) * 1e-18 / 2e-12), 1, 1e-9);
  EXPECT_NEAR(mean_first_passage(flat, 5e-9, 4e-9, 0, 1e-12) / ((25 - 1) * 1e-18 / 2e-12), 1, 1e-9);
}

}  // namespace
