#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/surface_forces/systems.hpp"

using namespace crumble;
using namespace crumble::systems;

namespace {

struct Set {
  std::vector<double> radius;
  Material material;
  BondLaws bonds;
  SurfaceForceLaws laws;
  Set(const SurfaceForces& f, std::vector<double> radii, const Material& m = {})
      : radius(std::move(radii)), material(m), bonds({}, material, radius), laws(f, bonds, radius) {}
};

SurfaceForces polystyrene() { return forces(9.85e-21, 0.04, 1); }

// Over 10 nm to 10 um the joining gap is that of h << a, to the curvature of the smallest.
TEST(JoinedAttraction, meets_the_pull_off_force_at_a_gap_that_does_not_depend_on_the_radius) {
  const double expected = std::sqrt(9.85e-21 / (18 * std::numbers::pi * 4.8e-3));
  EXPECT_NEAR(expected, 0.1905e-9, 0.0001e-9);
  for (const double a : {10e-9, 100e-9}) {
    const Set s(polystyrene(), {a, a});
    EXPECT_NEAR(s.laws(0, 1).attraction.joined_gap() / expected, 1, 2 * expected / a);
    EXPECT_NEAR(s.laws(0, 1).attraction.step() / s.laws(0, 1).attraction.contact().pull_off_force(), 0, 1e-9);
  }
}

TEST(JoinedAttraction, energy_and_force_are_continuous_and_force_is_the_slope_of_the_energy_at_every_gap) {
  for (const std::vector<double>& radii : {std::vector{10e-9, 10e-9}, {10e-9, 35e-9}, {1e-5, 1e-5}}) {
    const Set s(polystyrene(), radii);
    const PairForces pair = s.laws(0, 1);
    const JoinedAttraction& law = pair.attraction;
    const double h_po = law.lost_gap(), h_j = law.joined_gap(), F_po = law.contact().pull_off_force();
    ASSERT_GE(h_j, h_po);
    const bool steps = radii[0] > 1e-6;  // 10 um: h_po is beyond where van der Waals forces have fallen to F_po
    EXPECT_EQ(law.step() > 1e-6 * F_po, steps);
    for (const double join : {h_po, h_j}) {
      EXPECT_NEAR(law.energy(join * (1 - 1e-9)) / law.energy(join * (1 + 1e-9)), 1, 1e-6);
      if (!steps) {
        EXPECT_NEAR(law.tension(join * (1 - 1e-9)) / law.tension(join * (1 + 1e-9)), 1, 1e-4);
      }
    }
    for (double h = law.contact().equilibrium_gap(); h < 0.9 * pair.range; h += 0.013 * h_j + 0.05 * std::abs(h)) {
      const double d = 1e-5 * h_j;
      if (std::abs(h - h_po) < 2 * d || std::abs(h - h_j) < 2 * d) continue;
      EXPECT_NEAR((pair.open_energy(h + d) - pair.open_energy(h - d)) / (2 * d), pair.open_tension(h), 2e-5 * F_po)
          << h;
      EXPECT_NEAR((pair.bonded_energy(h + d) - pair.bonded_energy(h - d)) / (2 * d), pair.bonded_tension(h),
                  1e-6 * F_po);
    }
    EXPECT_NEAR(pair.open_energy(pair.range) / kT, 0, 1e-12);
  }
}

TEST(JoinedAttraction, without_a_Hamaker_constant_open_pairs_feel_no_contact_law) {
  const Set s(forces(0, 0.03, 1), {10e-9, 10e-9});
  for (const double h : {-1e-10, 1e-11, 1e-10}) EXPECT_EQ(s.laws(0, 1).attraction.tension(h), 0);
}

TEST(SurfaceForceLaws, range_ends_where_a_hundredth_of_kT_is_left_and_shrinks_with_salt) {
  Set s(forces(4.6e-21, 0.03, 1), {10e-9, 10e-9});
  const PairForces pair = s.laws(0, 1);
  EXPECT_NEAR(std::max(-pair.attraction.energy(pair.range), pair.repulsion.energy(pair.range)) / kT, 0.01, 1e-4);
  EXPECT_EQ(pair.open_tension(1.001 * pair.range), 0);
  const double before = s.laws.range();
  s.laws.set_ionic_strength(100);
  EXPECT_LT(s.laws.range(), 0.5 * before);
}

TEST(SurfaceForceLaws, kept_charge_lets_the_potential_fall_as_salt_rises_and_kept_potential_does_not) {
  SurfaceForces charged = forces(4.6e-21, 0, 1);
  charged.surface_charge = 0.01;
  const double before = surface_potential(charged, water(1), 10e-9),
               after = surface_potential(charged, water(100), 10e-9);
  EXPECT_LT(after, 0.5 * before);
  const SurfaceForces held = forces(4.6e-21, 0.03, 1);
  EXPECT_EQ(surface_potential(held, water(100), 10e-9), 0.03);
}

TEST(SurfaceForceLaws, repulsion_lowers_the_pull_off_force_in_the_liquid) {
  const Set s(forces(4.6e-21, 0.03, 100), {10e-9, 10e-9});
  const PairForces pair = s.laws(0, 1);
  const BondLaw& contact = pair.attraction.contact();
  // The largest tension of all gaps, looked for.
  double largest = 0;
  for (double h = contact.equilibrium_gap(); h <= 1e-9; h += 1e-4 * contact.lost_gap())
    largest = std::max(largest, pair.open_tension(h));
  EXPECT_NEAR(pair.pull_off_force() / largest, 1, 1e-5);
  EXPECT_LT(pair.pull_off_force(), contact.pull_off_force());
}

TEST(SurfaceForceLaws, stiffness_is_that_of_the_law) {
  const Set s(forces(9.85e-21, 0.04, 100), {10e-9, 10e-9});
  const PairForces pair = s.laws(0, 1);
  const double h_j = pair.attraction.joined_gap();
  // Just beyond the joining gap 2 F_po/h_j, less what the double layer takes off.
  EXPECT_GT(s.laws.largest_stiffness(), 2 * pair.attraction.contact().pull_off_force() / h_j * 0.9);
  const double gap = s.laws.gap_of_stiffness(0.01);
  double stiffest = 0;
  for (double h = gap; h < s.laws.range(); h *= 1.01)
    stiffest = std::max(stiffest, std::abs(pair.open_tension(1.0005 * h) - pair.open_tension(0.9995 * h)) / (1e-3 * h));
  EXPECT_LT(stiffest, 0.0101);
  EXPECT_GT(gap, h_j);
}

TEST(SurfaceForceLaws, unequal_particles_have_each_its_own_potential) {
  const Set s(forces(4.6e-21, 0.1, 1), {40e-9, 10e-9, 10e-9});
  const Electrolyte e = water(1);
  const double Y1 = effective_potential(e, 40e-9, 0.1), Y2 = effective_potential(e, 10e-9, 0.1);
  EXPECT_DOUBLE_EQ(s.laws(0, 1).repulsion.strength, double_layer(e, 40e-9, 10e-9, Y1, Y2).strength);
  EXPECT_DOUBLE_EQ(s.laws(1, 2).repulsion.strength, double_layer(e, 10e-9, 10e-9, Y2, Y2).strength);
}

}  // namespace
