#include "dryer/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dryer/inertial.hpp"
#include "dryer/regime.hpp"
#include "dryer/thermal_rupture.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

const std::string good = "[particle]\nradius = 10e-9\nnumber = 115\n[droplet]\nradius = 215e-9\nlifetime = 2.1e-4\n";

std::string complaint(const std::string& text) {
  try {
    drying_scene(Scene::parse(text, "drying.toml", drying_parameters()));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

struct Malformed {
  const char *name, *text, *expected;
};

class MalformedDryingScene : public ::testing::TestWithParam<Malformed> {};

TEST_P(MalformedDryingScene, is_refused_with_its_own_message) {
  const std::string found = complaint(GetParam().text);
  EXPECT_NE(found.find(GetParam().expected), std::string::npos) << found;
}

#define DROPLET "[droplet]\nradius = 215e-9\nlifetime = 2.1e-4\n"
#define BROWNIAN "[particle]\nradius = 10e-9\nnumber = 115\nbrownian_motion = true\n"
#define PARTICLE "[particle]\nradius = 10e-9\nnumber = 115\n"

INSTANTIATE_TEST_SUITE_P(
    Dryer, MalformedDryingScene,
    ::testing::Values(
        Malformed{"no_number", "[particle]\nradius = 10e-9\n" DROPLET,
                  "drying.toml: the number of particles is missing; give one of particle.number, "
                  "particle.solids_fraction"},
        Malformed{"number_and_solids_fraction", PARTICLE "solids_fraction = 0.01\n" DROPLET,
                  "drying.toml:4: particle.solids_fraction = 0.01: the number of particles is already given by "
                  "particle.number (drying.toml:3); remove one of the two"},
        Malformed{"less_than_one_particle", "[particle]\nradius = 10e-9\nsolids_fraction = 1e-5\n" DROPLET,
                  "one alone is a fraction of 0.000101"},
        Malformed{"too_much_solids", "[particle]\nradius = 10e-9\nsolids_fraction = 0.4\n" DROPLET,
                  "drying.toml:3: particle.solids_fraction = 0.4: fills 40 %"},
        Malformed{"more_particles_than_numbers", "[particle]\nradius = 1e-10\nsolids_fraction = 0.25\n" DROPLET,
                  "means 2.48e+09 particles"},
        Malformed{"theta_of_one", PARTICLE DROPLET "[output]\ntheta = [0.2, 1]\n",
                  "drying.toml:8: output.theta = [0.2, 1.0]: 1.0 must be > 0 and < 1"},
        Malformed{"theta_in_words", PARTICLE DROPLET "[output]\ntheta = \"half\"\n",
                  "must be a list of numbers > 0 and < 1, written [0.2, 0.4]"},
        Malformed{"no_speed_of_drying", PARTICLE "[droplet]\nradius = 215e-9\n",
                  "drying.toml: the speed of drying is missing; give one of droplet.lifetime, "
                  "droplet.evaporation_constant, droplet.front_speed, droplet.peclet"},
        Malformed{"lifetime_and_evaporation_constant", PARTICLE DROPLET "evaporation_constant = 2e-10\n",
                  "drying.toml:7: droplet.evaporation_constant = 2e-10 m2 s-1: the speed of drying is already given by "
                  "droplet.lifetime (drying.toml:6); remove one of the two"},
        Malformed{"peclet_and_front_speed", BROWNIAN "[droplet]\nradius = 215e-9\npeclet = 1\nfront_speed = 1e-4\n",
                  "drying.toml:7: droplet.peclet = 1.0: the speed of drying is already given by droplet.front_speed "
                  "(drying.toml:8)"},
        Malformed{"peclet_without_diffusion",
                  PARTICLE "brownian_motion = false\n[droplet]\nradius = 215e-9\npeclet = 1\n",
                  "drying.toml:7: droplet.peclet = 1.0: needs diffusion, but particle.brownian_motion = false "
                  "(drying.toml:4)"},
        Malformed{"water_that_is_steam", PARTICLE DROPLET "[fluid]\ntemperature = 400\nviscosity = \"water\"\n",
                  "drying.toml:8: fluid.temperature = 400.0 K: fluid.viscosity = \"water\" (drying.toml:9) is known "
                  "from 253.15 to 383.15 K"},
        Malformed{"water_that_is_ice", PARTICLE DROPLET "[fluid]\ntemperature = 240\nsurface_tension = \"water\"\n",
                  "fluid.surface_tension = \"water\" (drying.toml:9) is known from 248.15 to 647.096 K"},
        Malformed{"temperature_in_celsius", PARTICLE DROPLET "[fluid]\ntemperature = -5\n", "fluid.temperature"},
        Malformed{"another_liquid", PARTICLE DROPLET "[fluid]\nviscosity = \"oil\"\n",
                  "must be a number > 0 in Pa s, or \"water\""},
        Malformed{"particle_larger_than_droplet", "[particle]\nradius = 3e-7\nnumber = 1\n" DROPLET,
                  "drying.toml:2: particle.radius = 3e-07 m: no particle fits into droplet.radius = 2.15e-07 m "
                  "(drying.toml:5)"},
        Malformed{"distribution_without_its_width", PARTICLE "distribution = \"lognormal\"\n" DROPLET,
                  "drying.toml:4: particle.distribution = \"lognormal\": needs particle.geometric_standard_deviation"},
        Malformed{"width_without_a_distribution", PARTICLE "geometric_standard_deviation = 1.2\n" DROPLET,
                  "has a meaning only with particle.distribution = \"lognormal\""},
        Malformed{"second_kind_larger_than_the_droplet",
                  PARTICLE "distribution = \"bimodal\"\nsecond_radius = 1e-6\nsecond_share = 0.1\n" DROPLET,
                  "drying.toml:5: particle.second_radius = 1e-06 m: no particle fits"},
        Malformed{"too_many_large_particles",
                  PARTICLE "distribution = \"bimodal\"\nsecond_radius = 5e-8\nsecond_share = 0.5\n" DROPLET,
                  "particle.number = 115: fills 74 % of the droplet with solids"},
        Malformed{"contact_angle_that_nothing_wets", PARTICLE DROPLET "[fluid]\ncontact_angle = 180\n",
                  "fluid.contact_angle"},
        Malformed{"too_many_particles", "[particle]\nradius = 10e-9\nnumber = 5000\n" DROPLET, "2982 particles"},
        Malformed{"step_beyond_stability", PARTICLE DROPLET "[integrator]\nmethod = \"inertial\"\nstep = 1e-9\n",
                  "beyond the stability limit"},
        Malformed{"step_of_the_wrong_integrator", PARTICLE DROPLET "[integrator]\nstep = 1e-12\n",
                  "no meaning to the overdamped"},
        Malformed{"negative_lifetime", PARTICLE "[droplet]\nradius = 215e-9\nlifetime = -1\n", "droplet.lifetime"},
        Malformed{"unknown_law", PARTICLE DROPLET "[contact]\nlaw = \"hertz\"\n", "hertz"},
        Malformed{"misspelt", PARTICLE DROPLET "[contact]\nroling_limit_factor = 1\n",
                  "did you mean 'contact.rolling_limit_factor'"},
        Malformed{"no_particles", "[particle]\nradius = 10e-9\nnumber = 0\n" DROPLET, "particle.number"},
        Malformed{"half_a_particle", "[particle]\nradius = 10e-9\nnumber = 1.5\n" DROPLET, "particle.number"},
        Malformed{"poisson_beyond_half", PARTICLE DROPLET "[material]\npoisson_ratio = 0.6\n",
                  "material.poisson_ratio"},
        Malformed{"huge_step", PARTICLE DROPLET "[integrator]\nlargest_displacement = 3\n", "largest_displacement"},
        Malformed{"short_step_ten_times_too_long", PARTICLE DROPLET "[integrator]\ncontact_step = 1.5\n",
                  "integrator.contact_step"},
        Malformed{"radius_as_text", "[particle]\nradius = \"10 nm\"\nnumber = 115\n" DROPLET, "particle.radius"}),
    [](const auto& given) { return std::string(given.param.name); });

TEST(DryingScene, defaults_are_table_1_and_the_paper_s_equations) {
  const DryingScene s = drying_scene(Scene::parse(good, "drying.toml", drying_parameters()));
  EXPECT_EQ(s.radius.size(), 115u);
  EXPECT_EQ(s.model.material.youngs_modulus, 3.4e9);
  EXPECT_EQ(s.model.material.surface_energy, 4.8e-3);
  EXPECT_EQ(s.model.droplet.surface_tension, 1.75e-4);
  EXPECT_EQ(s.model.contact.rolling_limit_factor, 1);
  EXPECT_TRUE(s.is(IntegratorKind::stabilised));
}

TEST(DryingScene, steps_are_long_where_no_bond_breaks_thermally_and_it_says_so) {
  const auto scene = [](const std::string& radius, const std::string& droplet, const std::string& integrator) {
    return drying_scene(Scene::parse("[particle]\nradius = " + radius +
                                         "\nnumber = 20\nbrownian_motion = true\n[droplet]\n" + "radius = " + droplet +
                                         "\npeclet = 10\n" + integrator,
                                     "drying.toml", drying_parameters()));
  };
  const DryingScene strong = scene("100e-9", "1e-6", ""), weak = scene("10e-9", "1e-7", "");
  EXPECT_TRUE(strong.is(IntegratorKind::stabilised));
  EXPECT_TRUE(weak.is(IntegratorKind::brownian));
  EXPECT_TRUE(scene("100e-9", "1e-6", "[integrator]\nmethod = \"two-rate\"\n").is(IntegratorKind::brownian));
  EXPECT_THROW(scene("10e-9", "1e-7", "[integrator]\nmethod = \"stabilised\"\n"), InputError);
  const ThermalRupture rupture = thermal_rupture(strong);
  // (100/10)^(4/3) times the 4.2 kT of 10 nm.
  EXPECT_NEAR(rupture.bond / thermal_rupture(weak).bond, std::pow(10, 4.0 / 3), 1e-6);
  EXPECT_NEAR(thermal_rupture(weak).bond, 4.2, 0.05);
  const auto line = describe(strong).back();
  EXPECT_NE(line.find("a bond is worth 90.6 kT"), std::string::npos) << line;
}

TEST(DryingScene, frames_at_given_theta_come_in_between_the_even_ones) {
  const std::string text = good + "[output]\nframes = 1\ntheta = [0.96, 0.36, 0.75]\n";
  const DryingScene s = drying_scene(Scene::parse(text, "drying.toml", drying_parameters()));
  ASSERT_EQ(s.frames.size(), 3u);  // R/R0 = 0.5 is both theta = 0.75 and the even one
  EXPECT_NEAR(s.frames[0], 0.2, 1e-12);
  EXPECT_NEAR(s.frames[1], 0.5, 1e-12);
  EXPECT_NEAR(s.frames[2], 0.8, 1e-12);
}

TEST(DryingScene, description_says_what_will_happen) {
  const auto lines = describe(drying_scene(Scene::parse(good, "drying.toml", drying_parameters())));
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  EXPECT_NE(text.find("1.16 % solids"), std::string::npos) << text;
  EXPECT_NE(text.find("0.058 m/s"), std::string::npos) << text;
}

}  // namespace
