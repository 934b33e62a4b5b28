// What a formulator says, and what follows from it.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dryer/drag.hpp"
#include "dryer/expected_cost.hpp"
#include "dryer/regime.hpp"
#include "dryer/run.hpp"
#include "dryer/water_surface_tension.hpp"
#include "dryer/water_viscosity.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

DryingScene scene_of(const std::string& particle, const std::string& droplet, const std::string& more = "") {
  const std::string text =
      "[particle]\nradius = 10e-9\n" + particle + "\n[droplet]\nradius = 215e-9\n" + droplet + "\n" + more;
  return drying_scene(Scene::parse(text, "drying.toml", drying_parameters()));
}

DryingScene brownian(const std::string& droplet, const std::string& more = "") {
  return scene_of("number = 85\nbrownian_motion = true", droplet, more);
}

constexpr double round_off = 1e-14;  // relative, of a few products and quotients

TEST(DryingInputs, the_speed_of_drying_is_the_same_however_it_is_said) {
  const DryingScene by_lifetime = brownian("lifetime = 2.1e-3");
  const DryingRegime r = drying_regime(by_lifetime);
  for (const auto& said :
       {fmt::format("evaporation_constant = {:.17g}", r.evaporation_constant),
        fmt::format("front_speed = {:.17g}", r.front_speed), fmt::format("peclet = {:.17g}", r.peclet)})
    EXPECT_NEAR(brownian(said).model.droplet.lifetime, 2.1e-3, 2.1e-3 * round_off) << said;
}

TEST(DryingInputs, the_evaporation_constant_is_that_of_the_radius_squared) {
  const Droplet droplet = brownian("evaporation_constant = 2e-10").model.droplet;
  for (const double t : {0.0, 5e-5, 1e-4, 2e-4})
    EXPECT_NEAR(std::pow(droplet.radius(t), 2), 215e-9 * 215e-9 - 2e-10 * t, 215e-9 * 215e-9 * round_off) << t;
}

TEST(DryingInputs, the_front_speed_is_that_of_the_radius_at_the_start) {
  const Droplet droplet = brownian("front_speed = 1e-3").model.droplet;
  const double dt = 1e-6 * droplet.lifetime;  // the error of the difference is v dt/(2 tau)
  EXPECT_NEAR((droplet.radius(0) - droplet.radius(dt)) / dt, 1e-3, 1e-3 * 1e-6);
}

// D = 2.2e-11 m2/s and Pe of Table 2; both have two digits there.
TEST(DryingInputs, table_2_has_its_diffusivity_and_peclet_numbers) {
  EXPECT_NEAR(drying_regime(brownian("lifetime = 2.1e-4")).diffusivity, 2.2e-11, 0.01e-11);
  EXPECT_NEAR(drying_regime(brownian("lifetime = 2.1e-4")).peclet, 10, 0.05);
  EXPECT_NEAR(drying_regime(brownian("lifetime = 2.1e-3")).peclet, 1, 0.005);
}

TEST(DryingInputs, without_brownian_motion_the_peclet_number_is_infinite) {
  const DryingScene s = scene_of("number = 115\nbrownian_motion = false", "lifetime = 2.1e-4");
  EXPECT_EQ(s.model.thermal_energy, 0);
  EXPECT_TRUE(std::isinf(drying_regime(s).peclet));
}

TEST(DryingInputs, a_fraction_of_solids_becomes_the_nearest_number_of_particles) {
  EXPECT_EQ(scene_of("solids_fraction = 0.0116", "lifetime = 1e-4").radius.size(), 115u);
  // One particle is a fraction of 1.01e-4.
  for (const double phi : {2e-4, 0.01, 0.25})
    EXPECT_NEAR(drying_regime(scene_of(fmt::format("solids_fraction = {}", phi), "lifetime = 1e-4")).solids_fraction,
                phi, 0.51e-4);
}

TEST(DryingInputs, water_takes_both_properties_from_the_temperature) {
  const std::string water = "[fluid]\ntemperature = 330\nviscosity = \"water\"\nsurface_tension = \"water\"\n";
  const DryingScene s = brownian("lifetime = 2.1e-3", water);
  EXPECT_EQ(s.model.viscosity, water_viscosity(330));
  EXPECT_EQ(s.model.droplet.surface_tension, water_surface_tension(330));
  EXPECT_EQ(s.model.thermal_energy, boltzmann_constant * 330);
  EXPECT_NEAR(drying_regime(s).diffusivity, diffusivity(330, water_viscosity(330), 10e-9), 1e-25);
}

TEST(DryingInputs, one_property_may_be_water_s_and_the_other_given) {
  const DryingScene s = brownian("lifetime = 2.1e-3", "[fluid]\nviscosity = \"water\"\n");
  EXPECT_EQ(s.model.viscosity, water_viscosity(300));
  EXPECT_EQ(s.model.droplet.surface_tension, 1.75e-4);
}

TEST(DryingInputs, a_contact_angle_weakens_the_capillary_force_and_leaves_the_liquid_its_surface_tension) {
  const DryingScene s = brownian("lifetime = 2.1e-3", "[fluid]\ncontact_angle = 60\n");
  EXPECT_NEAR(s.model.droplet.surface_tension, 0.75 * 1.75e-4, 1.75e-4 * round_off);
  EXPECT_EQ(s.surface_tension, 1.75e-4);
  EXPECT_EQ(brownian("lifetime = 2.1e-3").model.droplet.surface_tension, 1.75e-4);
}

TEST(DryingRegime, names_what_the_peclet_number_decides) {
  const auto words = [](const std::string& droplet) { return drying_regime(brownian(droplet)).words(); };
  EXPECT_NE(words("peclet = 1").find("diffusion-dominated"), std::string::npos);
  EXPECT_NE(words("peclet = 30").find("between"), std::string::npos);
  EXPECT_NE(words("peclet = 1000").find("advection-dominated"), std::string::npos);
  const DryingScene still = scene_of("number = 115\nbrownian_motion = false", "lifetime = 1");
  EXPECT_NE(drying_regime(still).words().find("advection-dominated"), std::string::npos);
}

TEST(DryingRegime, the_capillary_speed_is_that_of_the_largest_force_for_any_radius) {
  const DryingRegime r = drying_regime(brownian("peclet = 1"));
  for (const double a : {1e-9, 10e-9, 1e-6})
    EXPECT_NEAR(capillary_force(1.75e-4, a, 0) / drag_coefficient(1e-3, a), r.capillary_speed,
                r.capillary_speed * round_off);
}

TEST(DryingRegime, a_front_faster_than_capillarity_is_called_so) {
  // The limit is 0.058 m/s; the front is R0/(2 tau) and, packed, 215/55 times as fast.
  const auto words = [](double speed) {
    return drying_regime(brownian(fmt::format("front_speed = {}", speed))).words();
  };
  EXPECT_EQ(words(0.01).find("capillary"), std::string::npos) << words(0.01);
  EXPECT_NE(words(0.03).find("capillary-limited at the end: below R = 111 nm"), std::string::npos) << words(0.03);
  EXPECT_NE(words(0.1).find("capillary-limited from the start"), std::string::npos) << words(0.1);
}

TEST(DryingRegime, everything_derived_is_said_and_reported) {
  const DryingScene s = brownian("peclet = 10");
  std::string text;
  for (const auto& line : describe(s)) text += line + "\n";
  for (const char* fact : {"N = 85", "phi = 0.86 %", "Pe = 10", "0.058 m/s", "diffusion-dominated"})
    EXPECT_NE(text.find(fact), std::string::npos) << fact << " in\n" << text;
  Report report("dryer", "0", "drying.toml", 1);
  report_regime(report, s);
  EXPECT_NE(report.json().find("\"peclet\": 10.0"), std::string::npos) << report.json();
}

TEST(ExpectedCost, the_number_of_steps_agrees_with_a_run) {
  DryingScene s = scene_of("number = 30\nbrownian_motion = false", "lifetime = 2.1e-4");
  s.model.droplet.initial_radius = 137e-9;  // 1.2 % solids
  s.model.droplet.lifetime = 8.5e-5;
  DryingRun run(s, 1);
  while (!run.finished()) run.step();
  const auto steps = static_cast<double>(run.integrator().statistics().steps);
  EXPECT_GT(expected_cost(s).work.steps, steps / 1.5);  // seeds alone scatter by a tenth
  EXPECT_LT(expected_cost(s).work.steps, steps * 1.5);
}

TEST(ExpectedCost, the_steps_of_a_brownian_run_are_its_own) {
  DryingScene s = brownian("peclet = 10");
  s.radius.resize(10);
  s.model.droplet.lifetime /= 10;
  DryingRun run(s, 1);
  while (!run.finished()) run.step();
  // When the softer stages end is estimated.
  const auto steps = static_cast<double>(run.integrator().statistics().steps);
  EXPECT_NEAR(expected_cost(s).work.steps, steps, 0.3 * steps);
}

TEST(Softening, ends_with_the_contacts_of_the_material_before_anything_is_dry_for_long) {
  DryingScene s = brownian("peclet = 10");
  s.radius.resize(10);
  s.model.droplet.lifetime /= 10;
  const auto stages = softening_stages(s);
  ASSERT_EQ(stages.size(), 4u);
  for (std::size_t k = 1; k < stages.size(); ++k) EXPECT_LT(stages[k].softening, stages[k - 1].softening);
  EXPECT_EQ(stages.back().softening, 1);
  DryingRun run(s, 1);
  const auto someone_is_dry = [&] {
    for (const Vector3& x : run.state().state.position)
      if (is_dry(s.nominal_radius, x.norm(), run.droplet_radius())) return true;
    return false;
  };
  while (!run.finished() && !someone_is_dry()) run.step();
  for (std::size_t k = 0; k < stages.size(); ++k) run.step();
  EXPECT_EQ(run.stage(), stages.size() - 1);
  s.softening = 1;
  EXPECT_EQ(softening_stages(s).size(), 1u) << "full stiffness is that throughout";
}

}  // namespace
