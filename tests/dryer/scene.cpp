#include "dryer/scene.hpp"

#include <gtest/gtest.h>

#include "dryer/inertial.hpp"

using namespace crumble;

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
#define PARTICLE "[particle]\nradius = 10e-9\nnumber = 115\n"

INSTANTIATE_TEST_SUITE_P(
    Dryer, MalformedDryingScene,
    ::testing::Values(
        Malformed{"no_number", "[particle]\nradius = 10e-9\n" DROPLET, "particle.number"},
        Malformed{"no_lifetime", PARTICLE "[droplet]\nradius = 215e-9\n", "droplet.lifetime"},
        Malformed{"particle_larger_than_droplet", "[particle]\nradius = 3e-7\nnumber = 1\n" DROPLET,
                  "drying.toml:2: particle.radius = 3e-07 m: no particle fits into droplet.radius = 2.15e-07 m "
                  "(drying.toml:5)"},
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
        Malformed{"radius_as_text", "[particle]\nradius = \"10 nm\"\nnumber = 115\n" DROPLET, "particle.radius"}),
    [](const auto& given) { return std::string(given.param.name); });

TEST(DryingScene, defaults_are_table_1_and_the_paper_s_equations) {
  const DryingScene s = drying_scene(Scene::parse(good, "drying.toml", drying_parameters()));
  EXPECT_EQ(s.radius.size(), 115u);
  EXPECT_EQ(s.model.material.youngs_modulus, 3.4e9);
  EXPECT_EQ(s.model.material.surface_energy, 4.8e-3);
  EXPECT_EQ(s.model.droplet.surface_tension, 1.75e-4);
  EXPECT_EQ(s.model.contact.rolling_limit_factor, 1);
  EXPECT_FALSE(s.inertial);
}

TEST(DryingScene, description_says_what_will_happen) {
  const auto lines = describe(drying_scene(Scene::parse(good, "drying.toml", drying_parameters())));
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  EXPECT_NE(text.find("1.16 % solids"), std::string::npos) << text;
  EXPECT_NE(text.find("0.058 m/s"), std::string::npos) << text;
}

}  // namespace
