// Two names of one thing: understood, or answered; never both.
#include <gtest/gtest.h>

#include "common/io/parameters.hpp"

using namespace crumble;

namespace {

const ParameterTable& table() {
  static const ParameterTable t{
      {"particle",
       "Spheres.",
       {Parameter::real("radius", "m", "Radius a").or_by("diameter", 0.5).not_called("particle.size").above(0),
        Parameter::real("share", "", "Share").or_by("percent", 0.01).above(0).below(1).optional()}}};
  return t;
}

Scene parse(const std::string& text, const std::vector<Override>& overrides = {}) {
  return Scene::parse(text, "s.toml", table(), overrides);
}

std::string refusal(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(accepted)";
}

}  // namespace

TEST(SceneSynonyms, a_diameter_is_twice_the_radius) {
  const Scene scene = parse("[particle]\ndiameter = 2e-8\npercent = 5\n");
  EXPECT_EQ(scene.real("particle.radius"), 1e-8);
  EXPECT_DOUBLE_EQ(scene.real("particle.share"), 0.05);
  EXPECT_EQ(scene.where("particle.radius"), "s.toml:2");
  EXPECT_EQ(scene.origin("particle.radius"), Scene::Origin::given);
  // What the file holds has one name for it.
  EXPECT_EQ(scene.resolved().find("diameter"), std::string::npos);
}

TEST(SceneSynonyms, both_ways_at_once_are_refused_with_both_lines) {
  EXPECT_EQ(refusal("[particle]\nradius = 1e-8\ndiameter = 2e-8\n"),
            "s.toml:2: particle.radius says again what particle.diameter says (s.toml:3); remove one of the two");
}

TEST(SceneSynonyms, an_override_takes_the_place_of_the_other_name) {
  EXPECT_EQ(parse("[particle]\nradius = 1e-8\n", {parse_override("particle.diameter=4e-8")}).real("particle.radius"),
            2e-8);
  EXPECT_EQ(parse("[particle]\ndiameter = 1e-8\n", {parse_override("particle.radius=3e-8")}).real("particle.radius"),
            3e-8);
}

TEST(SceneSynonyms, a_value_out_of_range_is_told_under_the_name_that_was_typed) {
  EXPECT_EQ(refusal("[particle]\ndiameter = -2e-8\n"),
            "s.toml:2: particle.radius = -1e-08 (from particle.diameter = -2e-08): must be > 0 m");
  EXPECT_EQ(refusal("[particle]\ndiameter = \"small\"\n"), "s.toml:2: particle.diameter = \"small\": must be a number");
  EXPECT_EQ(refusal("[particle]\nradius = 1e-8\n", {parse_override("particle.diameter=x")}),
            "--set: particle.diameter = x: must be a number");
}

TEST(SceneSynonyms, names_that_others_use_are_answered_with_ours) {
  EXPECT_EQ(refusal("[particle]\nradius = 1e-8\nsize = 2e-8\n"),
            "s.toml:3: unknown key 'particle.size'; it is called 'particle.radius' here");
  EXPECT_EQ(refusal("[particle]\nradius = 1e-8\ndiametre = 2e-8\n"),
            "s.toml:3: unknown key 'particle.diametre'; did you mean 'particle.diameter'?");
}

TEST(SceneSynonyms, the_manual_says_both_names) {
  EXPECT_NE(parameter_page(table()).find("Radius a; or `diameter`, 2 times that"), std::string::npos);
}
