#include "common/contact/jkr.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/contact/rolling.hpp"
#include "common/contact/sliding.hpp"
#include "common/contact/twisting.hpp"

using namespace crumble;

namespace {

// Half a unit of the last printed digit.
#define EXPECT_PRINTED(value, printed, unit) EXPECT_NEAR(value, printed, 0.51 * (unit))

TEST(Jkr, reproduces_the_constants_of_table_1_at_10_nm) {
  const Material m;
  const double a = 10e-9;
  const Jkr jkr(m, a);
  EXPECT_PRINTED(jkr.zero_load_radius, 1.14392e-9, 1e-14);
  EXPECT_PRINTED(jkr.pull_off_gap, 0.0346199e-9, 1e-16);
  EXPECT_PRINTED(jkr.equilibrium_gap, -0.0872e-9, 1e-13);
  EXPECT_PRINTED(jkr.pull_off_force, 2.261947e-10, 1e-16);
  EXPECT_PRINTED(jkr.tangent_stiffness(), 3.11, 1e-2);
  EXPECT_PRINTED(sliding_stiffness(m, a), 3.45516, 1e-5);
  EXPECT_PRINTED(twisting_stiffness(m, a), 4.523893e-18, 1e-24);
  EXPECT_PRINTED(rolling_stiffness(m, a), 4.523893e-18, 1e-24);
  EXPECT_PRINTED(sliding_limit(m, jkr.zero_load_radius), 2.32953e-10, 1e-15);
  EXPECT_PRINTED(rolling_limit(m, a, jkr.zero_load_radius), 1.03499e-19, 1e-24);
}

TEST(Jkr, reproduces_the_constants_of_table_1_at_100_nm) {
  const Material m;
  const double a = 100e-9;
  const Jkr jkr(m, a);
  EXPECT_PRINTED(jkr.zero_load_radius, 5.30960e-9, 1e-14);
  EXPECT_PRINTED(jkr.pull_off_gap, 0.0745864e-9, 1e-16);
  EXPECT_PRINTED(jkr.equilibrium_gap, -0.18795e-9, 1e-14);
  EXPECT_PRINTED(jkr.pull_off_force, 2.261947e-9, 1e-15);
  EXPECT_PRINTED(jkr.tangent_stiffness(), 14.442, 1e-3);
  EXPECT_PRINTED(jkr.secant_stiffness(), 8.616, 1e-3);
  EXPECT_PRINTED(sliding_stiffness(m, a), 16.0374, 1e-4);
  EXPECT_PRINTED(twisting_stiffness(m, a), 4.523893e-16, 1e-22);
  EXPECT_PRINTED(twisting_limit(m, a), 1.777e-17, 1e-20);
  EXPECT_PRINTED(rolling_stiffness(m, a), 4.523893e-16, 1e-22);
  EXPECT_PRINTED(sliding_limit(m, jkr.zero_load_radius), 5.01882e-9, 1e-14);
  EXPECT_PRINTED(rolling_limit(m, a, jkr.zero_load_radius), 4.80401e-18, 1e-23);
}

TEST(Jkr, reproduces_the_constants_of_table_1_at_1_um) {
  const Material m;
  const double a = 1e-6;
  const Jkr jkr(m, a);
  EXPECT_PRINTED(jkr.zero_load_radius, 24.6450e-9, 1e-13);
  EXPECT_PRINTED(jkr.pull_off_gap, 0.160691e-9, 1e-15);
  EXPECT_PRINTED(jkr.equilibrium_gap, -0.405e-9, 1e-12);
  EXPECT_PRINTED(jkr.pull_off_force, 2.261947e-8, 1e-14);
  EXPECT_PRINTED(jkr.tangent_stiffness(), 67.0, 1e-1);
  EXPECT_PRINTED(sliding_stiffness(m, a), 74.4392, 1e-4);
  EXPECT_PRINTED(rolling_stiffness(m, a), 4.523893e-14, 1e-20);
  EXPECT_PRINTED(sliding_limit(m, jkr.zero_load_radius), 1.08127e-7, 1e-12);
  EXPECT_PRINTED(rolling_limit(m, a, jkr.zero_load_radius), 2.22983e-16, 1e-21);
}

TEST(Jkr, is_equation_10_with_the_sign_of_the_force_reversed) {
  const Jkr jkr(Material{}, 10e-9);
  // Eq. 10 in the paper's sign: F_n positive in compression.
  for (double F_n = -jkr.pull_off_force; F_n < 20 * jkr.pull_off_force; F_n += 0.0371 * jkr.pull_off_force) {
    const double root = std::sqrt(1 + F_n / jkr.pull_off_force);
    const double b0 = jkr.zero_load_radius;
    const double h = b0 * b0 / 10e-9 * std::cbrt((1 + root) / 2) * (1 - 3 * root) / 3;
    EXPECT_NEAR(jkr.gap(-F_n), h, 1e-14 * b0);
    EXPECT_NEAR(jkr.tension(h), -F_n, 1e-12 * (jkr.pull_off_force + std::abs(F_n)));  // round-off of the inverse
  }
}

TEST(Jkr, tension_is_the_derivative_of_the_energy_and_stiffness_that_of_tension) {
  const Jkr jkr(Material{}, 10e-9);
  const double d = 1e-5 * jkr.length;  // truncation d^2 ~ 1e-10, round-off 1e-16/1e-5 ~ 1e-11 of the scale
  for (double h = -5 * jkr.length; h < jkr.pull_off_gap - 0.01 * jkr.length; h += 0.0173 * jkr.length) {
    const auto [tension, stiffness] = jkr.state(h);
    EXPECT_NEAR((jkr.energy(h + d) - jkr.energy(h - d)) / (2 * d), tension, 1e-8 * jkr.pull_off_force * 20);
    EXPECT_NEAR((jkr.tension(h + d) - jkr.tension(h - d)) / (2 * d), stiffness, 1e-6 * jkr.tangent_stiffness());
  }
}

TEST(Jkr, pulls_off_where_equations_6_and_11_say) {
  for (const double a : {10e-9, 100e-9, 1e-6}) {
    const Jkr jkr(Material{}, a);
    EXPECT_NEAR(jkr.gap(jkr.pull_off_force) / jkr.pull_off_gap, 1, 1e-12);
    EXPECT_NEAR(jkr.tension(jkr.pull_off_gap * (1 - 1e-9)) / jkr.pull_off_force, 1, 1e-12);
    EXPECT_NEAR(jkr.tension(jkr.equilibrium_gap) / jkr.pull_off_force, 0, 1e-13);
    EXPECT_NEAR(jkr.tension(0) / jkr.pull_off_force, 8.0 / 9.0, 1e-13);
    EXPECT_NEAR(jkr.state(jkr.equilibrium_gap).stiffness / jkr.tangent_stiffness(), 1, 1e-12);
  }
}

TEST(Jkr, work_of_detachment_is_4_2_kT_at_10_nm_and_the_integral_of_the_tension) {
  const Jkr jkr(Material{}, 10e-9);
  const double work = jkr.energy(jkr.pull_off_gap);
  EXPECT_NEAR(work, 17.4e-21, 0.05e-21);  // two-sphere pull test in LAMMPS granular/jkr: 17.4e-21 J
  EXPECT_NEAR(work / (1.380649e-23 * 300), 4.2, 0.05);
  double integral = 0;
  const int n = 20000;  // midpoint rule; the end point has a finite slope in h, so the error is O(1/n^2) ~ 1e-8
  const double width = (jkr.pull_off_gap - jkr.equilibrium_gap) / n;
  for (int k = 0; k < n; ++k) integral += jkr.tension(jkr.equilibrium_gap + (k + 0.5) * width) * width;
  EXPECT_NEAR(integral / work, 1, 1e-6);
}

TEST(Jkr, making_a_contact_at_zero_gap_returns_less_than_breaking_it_costs) {
  const Jkr jkr(Material{}, 10e-9);
  const double kT = 1.380649e-23 * 300;
  EXPECT_NEAR(jkr.energy(0) / kT, 2.4, 0.05);
  EXPECT_LT(jkr.energy(0), jkr.energy(jkr.pull_off_gap));
}

TEST(Jkr, stays_finite_under_extreme_compression) {
  const Jkr jkr(Material{}, 10e-9);
  for (const double overlap : {1e-10, 1e-9, 5e-9, 1e-8, 1e-6}) {
    const auto [tension, stiffness] = jkr.state(-overlap);
    EXPECT_TRUE(std::isfinite(tension) && std::isfinite(stiffness));
    EXPECT_NEAR(jkr.gap(tension) / -overlap, 1, 1e-10);
  }
}

TEST(Jkr, takes_unequal_radii_through_the_reduced_radius) {
  EXPECT_DOUBLE_EQ(pair_radius(3e-9, 3e-9), 3e-9);
  EXPECT_DOUBLE_EQ(pair_radius(1e-9, 3e-9), 1.5e-9);
  EXPECT_DOUBLE_EQ(pull_off_force(Material{}, pair_radius(1e-9, 1)), 2 * pull_off_force(Material{}, 1e-9) / (1 + 1e-9));
}

TEST(Rolling, is_the_bending_stiffness_of_the_bonded_disc) {
  const Material m;
  const Jkr jkr(m, 1e-7);
  const double b0 = jkr.zero_load_radius, nu = m.poisson_ratio;
  EXPECT_NEAR(rolling_stiffness(m, 1e-7) / (2.0 / 3.0 * m.youngs_modulus * b0 * b0 * b0 / (1 - nu * nu)), 1, 1e-12);
  EXPECT_NEAR(rolling_stiffness(m, 1e-7) / (4 * jkr.pull_off_force * 0.5e-7), 1, 1e-12);
}

TEST(Twisting, limit_angle_does_not_depend_on_the_material) {
  for (const double E : {1e7, 3.4e9})
    for (const double nu : {0.2, 0.5}) {
      const Material m{E, nu, 4.8e-3, 1300};
      const Jkr jkr(m, 1e-7);
      const double phi = 0.05 * E * std::pow(jkr.zero_load_radius, 3) / (18 * 4.8e-3 * 1e-14 * (1 - nu * nu));
      EXPECT_NEAR(twisting_limit(m, 1e-7) / twisting_stiffness(m, 1e-7) / phi, 1, 1e-12);  // Eq. 17
    }
}

}  // namespace
