#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/surface_forces/surface_charge.hpp"
#include "tests/surface_forces/systems.hpp"

using namespace crumble;
using namespace crumble::systems;
using std::numbers::pi;

namespace {

// Central difference; its own error at this width is 1e-8 of the slope for laws of the lengths here.
template <class F>
double slope(F f, double h) {
  const double d = 1e-4 * h;
  return (f(h + d) - f(h - d)) / (2 * d);
}

TEST(VanDerWaals, force_is_the_slope_of_the_energy_for_all_sizes_gaps_and_wavelengths) {
  for (const double ratio : {1.0, 3.0, 50.0})
    for (const double wavelength : {0.0, 100e-9})
      for (double h = 1e-11; h < 1e-6; h *= 3) {
        const VanDerWaals law{1e-20, 20e-9, ratio * 20e-9, retardation_rate(wavelength)};
        EXPECT_NEAR(slope([&](double x) { return law.energy(x); }, h) / law.tension(h), 1, 1e-6) << ratio << " " << h;
      }
}

TEST(VanDerWaals, is_symmetric_and_Derjaguins_near_contact_and_falls_with_the_sixth_power_far_away) {
  const double A = 1e-20, a1 = 20e-9, a2 = 70e-9;
  const VanDerWaals law{A, a1, a2, 0}, other{A, a2, a1, 0};
  EXPECT_DOUBLE_EQ(law.energy(3e-9), other.energy(3e-9));
  EXPECT_NEAR(law.energy(1e-13) / (-A * a1 * a2 / (6 * (a1 + a2) * 1e-13)), 1, 1e-3);
  // London: -(16/9) A a1^3 a2^3/r^6.
  const double r = 1e-4;
  EXPECT_NEAR(law.energy(r - a1 - a2) / (-16.0 / 9 * A * std::pow(a1 * a2, 3) / std::pow(r, 6)), 1, 1e-5);
}

TEST(VanDerWaals, sphere_and_plane_are_the_limit_of_a_large_partner) {
  const double A = 1e-20, a = 20e-9, h = 7e-9;
  const VanDerWaals law{A, a, 1.0, 0};
  EXPECT_NEAR(law.energy(h) / (-A / 6 * (a / h + a / (h + 2 * a) + std::log(h / (h + 2 * a)))), 1, 1e-6);
}

TEST(VanDerWaals, retardation_is_the_factor_of_Gregory) {
  const VanDerWaals law{1e-20, 1e-7, 1e-7, 0}, retarded{1e-20, 1e-7, 1e-7, retardation_rate(100e-9)};
  EXPECT_NEAR(retarded.energy(10e-9) / law.energy(10e-9), 1 / (1 + 14 * 0.1), 1e-12);
}

TEST(VanDerWaals, surface_energy_of_polystyrene_in_water_is_that_of_the_paper) {
  EXPECT_NEAR(surface_energy_of(9.85e-21), 4.8e-3, 0.003e-3);
}

TEST(Electrolyte, debye_length_of_water_at_25_C) {
  EXPECT_NEAR(1 / water(1000).inverse_debye_length(), 0.304e-9, 0.0005e-9);
  EXPECT_NEAR(1 / water(1).inverse_debye_length(), 9.61e-9, 0.01e-9);
}

TEST(Electrolyte, salt_is_kept_while_the_liquid_goes_and_crystallises_beyond_its_solubility) {
  EXPECT_DOUBLE_EQ(concentrated(10, 8e-21, 1e-21, 5400), 80);
  EXPECT_DOUBLE_EQ(concentrated(10, 8e-21, 8e-21, 5400), 10);
  EXPECT_EQ(concentrated(10, 8e-21, 1e-24, 5400), 5400);
  EXPECT_EQ(concentrated(10, 8e-21, 0, 5400), 5400);
}

// y'' + (2/x) y' = sinh y outside a sphere, x = kappa r, from far away, where y = Y x0/x e^-(x - x0), inwards by the
// classical Runge-Kutta method.
struct PoissonBoltzmann {
  double potential, slope;  // y and dy/dx at the surface
};
PoissonBoltzmann exact(double kappa_a, double Y) {
  constexpr int steps = 40000;
  const double x0 = kappa_a, width = -20.0 / steps;
  double x = x0 + 20, y = Y * x0 / x * std::exp(-20.0), dy = -y * (1 + 1 / x);
  const auto acceleration = [](double at, double u, double v) { return std::sinh(u) - 2 / at * v; };
  for (int k = 0; k < steps; ++k) {
    const double k1 = dy, l1 = acceleration(x, y, dy);
    const double k2 = dy + width / 2 * l1, l2 = acceleration(x + width / 2, y + width / 2 * k1, k2);
    const double k3 = dy + width / 2 * l2, l3 = acceleration(x + width / 2, y + width / 2 * k2, k3);
    const double k4 = dy + width * l3, l4 = acceleration(x + width, y + width * k3, k4);
    y += width / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    dy += width / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
    x += width;
  }
  return {y, dy};
}

// Electrolyte in which a sphere of 10 nm has this kappa a.
Electrolyte with_kappa_a(double kappa_a) {
  const double of_one = water(1).inverse_debye_length() * 10e-9;
  return water(kappa_a * kappa_a / (of_one * of_one));
}

// Potentials y up to 8, kT/e. Largest deviations found: from kappa a = 1 on 0.38 % (Y) and 0.1 % (charge); at kappa a =
// 0.3 and 0.1 of Y 0.27 % and 0.43 % at y = 1, then growing like y^2, and less of the charge.
TEST(DoubleLayer, effective_potential_and_charge_are_those_of_the_Poisson_Boltzmann_equation) {
  for (const double kappa_a : {0.1, 0.3, 1.0, 3.0, 10.0, 100.0})
    for (const double Y : {0.1, 1.0, 2.0, 3.5}) {
      const PoissonBoltzmann found = exact(kappa_a, Y);
      ASSERT_LT(found.potential, 8);
      const Electrolyte e = with_kappa_a(kappa_a);
      const double y = found.potential, psi = y * e.thermal_voltage();
      const double charge = -e.permittivity * e.inverse_debye_length() * e.thermal_voltage() * found.slope;
      const double thick = 0.0045 * y * y;
      EXPECT_NEAR(effective_potential(e, 10e-9, psi) / Y, 1, kappa_a < 1 ? thick : 0.0045) << kappa_a << " " << y;
      EXPECT_NEAR(surface_charge(e, 10e-9, psi) / charge, 1, kappa_a < 1 ? thick : 0.0015) << kappa_a << " " << y;
    }
}

TEST(DoubleLayer, limits_of_thin_and_thick_layers) {
  for (const double psi : {0.01, 0.03, 0.1}) {
    const double volt = kT / elementary_charge;
    EXPECT_NEAR(effective_potential(with_kappa_a(1e5), 10e-9, psi), 4 * std::tanh(psi / volt / 4), 1e-4);
    EXPECT_NEAR(effective_potential(with_kappa_a(1e-6), 10e-9, psi), 8 * std::tanh(psi / volt / 8), 1e-6);
  }
  const double small = 1e-5;
  for (const double kappa_a : {1e-3, 1.0, 1e3})
    EXPECT_NEAR(effective_potential(with_kappa_a(kappa_a), 10e-9, small) / (small * elementary_charge / kT), 1, 1e-6);
  // Thin layers: 32 pi eps a (kT/e)^2 g^2 e^-kappa h.
  const Electrolyte e = with_kappa_a(1e5);
  const double Y = effective_potential(e, 10e-9, 0.03), volt = e.thermal_voltage(), g = std::tanh(0.03 / volt / 4);
  const double h = 1 / e.inverse_debye_length();
  EXPECT_NEAR(double_layer(e, 10e-9, 10e-9, Y, Y).energy(h) /
                  (32 * pi * e.permittivity * 10e-9 * volt * volt * g * g * std::exp(-1)),
              1, 1e-4);
  // No salt: two charges Q = 4 pi eps a psi.
  const double a = 10e-9, r = 50e-9, Q = 4 * pi * e.permittivity * a * small;
  const Electrolyte none = with_kappa_a(1e-6);
  const double Y0 = effective_potential(none, a, small);
  EXPECT_NEAR(double_layer(none, a, a, Y0, Y0).energy(r - 2 * a) / (Q * Q / (4 * pi * e.permittivity * r)), 1, 1e-5);
}

TEST(DoubleLayer, force_is_the_slope_of_the_energy_and_unequal_spheres_repel_each_other_alike) {
  const Electrolyte e = water(3);
  const double Y1 = effective_potential(e, 10e-9, 0.03), Y2 = effective_potential(e, 40e-9, 0.03);
  const DoubleLayer law = double_layer(e, 10e-9, 40e-9, Y1, Y2), other = double_layer(e, 40e-9, 10e-9, Y2, Y1);
  for (double h = 1e-10; h < 1e-7; h *= 2) {
    EXPECT_NEAR(slope([&](double x) { return law.energy(x); }, h) / law.tension(h), 1, 1e-6);
    EXPECT_DOUBLE_EQ(law.energy(h), other.energy(h));
    EXPECT_NEAR(slope([&](double x) { return law.tension(x); }, h) / law.stiffness(h), 1, 1e-6);
  }
}

TEST(DoubleLayer, pushes_no_harder_across_a_contact_than_at_gap_zero) {
  const Electrolyte e = water(100);
  const double Y = effective_potential(e, 100e-9, 0.04);
  const DoubleLayer law = double_layer(e, 100e-9, 100e-9, Y, Y);
  for (const double h : {-1e-12, -1e-10, -1e-9}) {
    EXPECT_EQ(law.tension(h), law.tension(0));
    EXPECT_NEAR(law.energy(h), law.energy(0) + law.tension(0) * h, 1e-12 * law.energy(0));
  }
}

TEST(SurfaceCharge, is_Grahames_for_a_plane_and_Debyes_for_small_potentials_and_has_an_inverse) {
  const double volt = kT / elementary_charge;
  const Electrolyte plane = with_kappa_a(1e6);
  EXPECT_NEAR(surface_charge(plane, 10e-9, 0.08) /
                  (2 * plane.permittivity * plane.inverse_debye_length() * volt * std::sinh(0.08 / volt / 2)),
              1, 1e-5);
  for (const double kappa_a : {0.01, 1.0, 100.0}) {
    const Electrolyte e = with_kappa_a(kappa_a);
    EXPECT_NEAR(surface_charge(e, 10e-9, 1e-4) / (e.permittivity * e.inverse_debye_length() * 1e-4 * (1 + 1 / kappa_a)),
                1, 1e-5);
    for (const double psi : {-0.1, -1e-3, 0.02, 0.15})
      EXPECT_NEAR(surface_potential(e, 10e-9, surface_charge(e, 10e-9, psi)) / psi, 1, 1e-9);
  }
  EXPECT_EQ(surface_potential(water(1), 10e-9, 0), 0);
}

}  // namespace
