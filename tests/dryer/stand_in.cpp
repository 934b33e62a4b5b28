// A smaller droplet that stands for a larger one.
#include "dryer/stand_in.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dryer/expected_cost.hpp"
#include "dryer/process_inputs.hpp"
#include "dryer/regime.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

Scene spray(const std::string& more) {
  return Scene::parse("[particle]\ndiameter = 200e-9\n" + more, "spray.toml", drying_parameters());
}

const char* const brownian =
    "weight_fraction = 0.05\nbrownian_motion = true\n[material]\ndensity = 2000\n"
    "[droplet]\ndiameter = 50e-6\n";

DryingScene small_of(const Scene& large, double number) {
  return drying_scene(Scene::parse(stand_in(large, number), "small.toml", drying_parameters()));
}

constexpr double round_off = 1e-9;

}  // namespace

TEST(StandIn, a_weight_fraction_is_a_volume_fraction_by_the_densities) {
  EXPECT_NEAR(volume_fraction(0.05, 2000, 1000), (0.05 / 2000) / (0.05 / 2000 + 0.95 / 1000), 1e-15);
  EXPECT_DOUBLE_EQ(volume_fraction(0.3, 1234, 1234), 0.3);
  const Scene scene = spray(std::string(brownian) + "lifetime = 0.5\n");
  EXPECT_EQ(particle_number(scene), std::round(volume_fraction(0.05, 2000, 997) * std::pow(250, 3)));
}

TEST(StandIn, a_weight_fraction_without_a_density_says_so) {
  try {
    particle_number(spray("weight_fraction = 0.05\n[droplet]\nradius = 1e-6\nlifetime = 1e-3\n"));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("needs material.density"), std::string::npos) << error.what();
  }
}

// However the speed of drying is said: Pe, solids and forces are those of the large droplet.
TEST(StandIn, with_brownian_motion_the_peclet_number_is_kept) {
  for (const char* speed :
       {"lifetime = 0.5", "evaporation_constant = 1.25e-9", "front_speed = 2.5e-5", "peclet = 583"}) {
    const Scene large = spray(fmt::format("{}{}\n", brownian, speed));
    const DryingRegime a = drying_regime(small_of(large, 2000)), b = drying_regime(small_of(large, 250));
    EXPECT_NEAR(a.peclet / b.peclet, 1, round_off) << speed;
    EXPECT_NEAR(a.solids_fraction / b.solids_fraction, 1, 0.01) << speed;  // whole particles
    EXPECT_NEAR(a.force_ratio / b.force_ratio, 1, round_off) << speed;
    EXPECT_NEAR(b.front_speed / a.front_speed, 2, 0.02) << speed;  // the eighth of the particles, half the radius
    EXPECT_NEAR(static_cast<double>(small_of(large, 2000).radius.size()), 2000, 2) << speed;
  }
  const double D = 1.380649e-23 * 300 / (6 * M_PI * 1e-3 * 100e-9);
  EXPECT_NEAR(drying_regime(small_of(spray(std::string(brownian) + "lifetime = 0.5\n"), 500)).peclet,
              std::pow(25e-6, 2) / (0.5 * D), 1);
}

TEST(StandIn, without_it_the_speed_of_the_front_is_kept) {
  for (const char* speed : {"lifetime = 0.5", "evaporation_constant = 1.25e-9", "front_speed = 2.5e-5"}) {
    const Scene large = spray(fmt::format("solids_fraction = 0.02\n[droplet]\nradius = 25e-6\n{}\n", speed));
    const DryingRegime a = drying_regime(small_of(large, 2000));
    EXPECT_NEAR(a.front_speed, 2.5e-5, 2.5e-5 * round_off) << speed;
    EXPECT_NEAR(a.solids_fraction, 0.02, 2e-5) << speed;
  }
}

TEST(StandIn, the_scene_says_what_it_stands_for_and_what_is_lost) {
  const Scene large = spray(std::string(brownian) + "lifetime = 0.5\n");
  const std::string text = stand_in(large, 2000);
  const Scene small = Scene::parse(text, "small.toml", drying_parameters());
  EXPECT_EQ(small.real("stands_for.number"), particle_number(large));
  for (const char* said : {"# Kept: solids", "Pe = ", "pull-off force", "# Lost: layers", "# Lost: front speed"})
    EXPECT_NE(text.find(said), text.npos) << text;
}

TEST(StandIn, a_time_gives_as_many_particles_as_dry_in_it) {
  const Scene large = spray("solids_fraction = 0.02\n[droplet]\nradius = 25e-6\nlifetime = 0.5\n");
  const auto number_in = [&](const char* time) {
    return Scene::parse(stand_in(large, fit_to(time), this_machine()), "s.toml", drying_parameters());
  };
  const double of_minutes = particle_number(number_in("5 min")), of_hours = particle_number(number_in("5 h"));
  EXPECT_GT(of_hours, 3 * of_minutes);  // the clock is this machine's; time grows like N^1.5 or so
}

TEST(StandIn, what_cannot_be_meant_is_refused) {
  for (const char* wrong : {"", "10", "1.5", "2000.5", "1 year", "-1 h", "h", "nan"})
    EXPECT_THROW(fit_to(wrong), InputError) << wrong;
  EXPECT_EQ(*fit_to("2000").number, 2000);
  EXPECT_EQ(*fit_to("90 s").seconds, 90);
  EXPECT_EQ(*fit_to("2 days").seconds, 172800);
  const Scene large = spray("number = 100\n[droplet]\nradius = 1e-6\nlifetime = 1e-3\n");
  EXPECT_THROW(stand_in(large, fit_to("100"), this_machine()), InputError);
}
