#include "dryer/droplet.hpp"

#include <gtest/gtest.h>

#include "dryer/capillary.hpp"
#include "dryer/drag.hpp"
#include "dryer/surface_pull.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

constexpr double a = 10e-9, sigma = 1.75e-4;
const Droplet droplet{215e-9, 2.1e-4, sigma};

TEST(Droplet, loses_surface_at_a_constant_rate) {
  for (const double t : {0.0, 0.3e-4, 1.7e-4, 2.0999e-4}) {
    const double R = droplet.radius(t);
    EXPECT_NEAR(R * R, 215e-9 * 215e-9 * (1 - t / 2.1e-4), 1e-28);
    EXPECT_NEAR(droplet.time_at(R), t, 1e-18);
    const double dt = 1e-10;
    if (t == 0) continue;
    EXPECT_NEAR((droplet.radius(t - dt) - droplet.radius(t + dt)) / (2 * dt) / droplet.front_speed(R), 1, 1e-3);
  }
  EXPECT_EQ(droplet.radius(2.1e-4), 0);
  EXPECT_EQ(droplet.radius(1), 0);
}

TEST(SurfacePull, is_the_capillary_force_over_the_distance_in_single_precision) {
  const double full = capillary_force(sigma, a, 0);
  for (const double R : {215e-9, 40e-9, 8e-9}) {
    for (double r = std::max(R - 1.1 * a, 0.05 * a); r < R + 1.1 * a; r += 0.0371 * a) {
      const double law = surface_cuts(a, r, R) ? capillary_force(sigma, a, r - R) : 0;
      const auto s = static_cast<float>(sigma), front = static_cast<float>(R), radius = static_cast<float>(a),
                 excess = static_cast<float>(r * r - R * R), pull = surface_pull(s, front, radius, excess);
      const double of_many = surface_pull<Lane>(s, front, radius, excess)[lanes - 1];
      EXPECT_NEAR(-of_many * r, law, 1e-5 * full) << r / a << " of " << R / a;
      EXPECT_NEAR(-static_cast<double>(pull) * r, law, 1e-5 * full) << r / a << " of " << R / a;
    }
  }
}

TEST(CapillaryForce, is_the_derivative_of_its_energy_and_acts_only_on_what_the_surface_cuts) {
  EXPECT_EQ(capillary_force(sigma, a, -a), 0);
  EXPECT_EQ(capillary_force(sigma, a, a), 0);
  EXPECT_EQ(capillary_force(sigma, a, 1.2 * a), 0);
  EXPECT_NEAR(capillary_force(sigma, a, 0), 2 * std::numbers::pi * a * sigma, 1e-24);
  EXPECT_EQ(capillary_energy(sigma, a, -1.5 * a), 0);
  const double d = 1e-5 * a, full = capillary_force(sigma, a, 0);
  for (double s = -0.99 * a; s < 0.995 * a; s += 0.0371 * a) {
    EXPECT_NEAR((capillary_energy(sigma, a, s + d) - capillary_energy(sigma, a, s - d)) / (2 * d),
                capillary_force(sigma, a, s), 1e-6 * full);
    EXPECT_NEAR((capillary_force(sigma, a, s + d) - capillary_force(sigma, a, s - d)) / (2 * d),
                capillary_slope(sigma, a, s), 1e-4 * std::abs(capillary_slope(sigma, a, s)) + 1e-6 * full / a);
  }
}

// The force on a sphere pulled out through a flat surface is 2 pi sigma a sin(phi) sin(phi + theta) with the contact
// line at the angle phi; its largest value, searched for, is that of the law.
TEST(CapillaryForce, of_a_contact_angle_is_the_largest_that_the_meniscus_can_bear) {
  EXPECT_EQ(wetting_factor(0), 1);  // Eq. 8
  for (const double theta : {0.0, 0.4, std::numbers::pi / 2, 2.5}) {
    double largest = 0;
    for (double phi = 0; phi < std::numbers::pi - theta; phi += 1e-4)
      largest = std::max(largest, std::sin(phi) * std::sin(phi + theta));
    EXPECT_NEAR(wetting_factor(theta), largest, 1e-8);  // (1e-4)^2 of the search
  }
}

TEST(Drag, gives_the_paper_its_diffusivity_and_capillary_speed_limit) {
  EXPECT_NEAR(diffusivity(300, 1e-3, a), 2.2e-11, 0.05e-11);  // Table 2
  EXPECT_NEAR(capillary_force(sigma, a, 0) / drag_coefficient(1e-3, a), sigma / (3 * 1e-3), 1e-15);
  EXPECT_NEAR(rotational_drag_coefficient(1e-3, a) / drag_coefficient(1e-3, a), 4.0 / 3.0 * a * a, 1e-30);
}

}  // namespace
