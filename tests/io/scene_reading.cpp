#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>

#include "tests/io/scene_table.hpp"

using namespace crumble;
using crumble::testing::good_scene;
using crumble::testing::table;

namespace {

Scene parse(const std::string& text, const std::vector<Override>& overrides = {}) {
  return Scene::parse(text, "drying.toml", table(), overrides);
}

}  // namespace

TEST(SceneReading, gives_values_of_the_file_and_defaults_elsewhere) {
  const Scene scene = parse(good_scene);
  EXPECT_EQ(scene.real("droplet.radius"), 215e-9);
  EXPECT_EQ(scene.integer("particle.number"), 115);
  EXPECT_EQ(scene.real("particle.radius"), 10e-9);
  EXPECT_EQ(scene.choice("contact.law"), "jkr");
  EXPECT_TRUE(scene.flag("contact.rolling"));
  EXPECT_EQ(scene.text("run.title"), "");
  EXPECT_EQ(scene.given(), good_scene);
}

TEST(SceneReading, knows_where_each_value_comes_from) {
  const Scene scene = parse(good_scene, {parse_override("run.frames = 7"), {"run.seed", "3", "--seed"}});
  EXPECT_EQ(scene.where("droplet.radius"), "drying.toml:6");
  EXPECT_EQ(scene.where("particle.number"), "drying.toml:3");
  EXPECT_EQ(scene.where("particle.radius"), "default");
  EXPECT_EQ(scene.where("run.frames"), "--set");
  EXPECT_EQ(scene.where("run.seed"), "--seed");
}

TEST(SceneReading, an_error_in_a_relation_names_the_line_and_the_value) {
  const Scene scene = parse(good_scene);
  EXPECT_STREQ(scene.error("droplet.radius", "must exceed particle.radius").what(),
               "drying.toml:6: droplet.radius = 2.15e-07 m: must exceed particle.radius");
  EXPECT_STREQ(scene.error("particle.solids_fraction", "give this or particle.number").what(),
               "drying.toml: particle.solids_fraction (not set): give this or particle.number");
}

TEST(SceneReading, optional_parameters_say_whether_they_are_set) {
  const Scene scene = parse(good_scene);
  EXPECT_TRUE(scene.is_set("particle.number"));
  EXPECT_FALSE(scene.is_set("particle.solids_fraction"));
  EXPECT_THROW(scene.real("particle.solids_fraction"), std::logic_error);
}

TEST(SceneReading, a_whole_number_is_a_real_number) {
  EXPECT_EQ(parse("droplet.radius = 1\nparticle.density = 1000").real("particle.density"), 1000.0);
}

TEST(SceneReading, inline_and_dotted_tables_are_the_same_as_sections) {
  EXPECT_EQ(parse("droplet = {radius = 2e-7}\nparticle.radius = 1e-8").real("droplet.radius"), 2e-7);
}

TEST(SceneReading, the_last_of_several_overrides_wins) {
  const Scene scene =
      parse(good_scene, {parse_override("particle.radius=2e-8"), parse_override("particle.radius=3e-8")});
  EXPECT_EQ(scene.real("particle.radius"), 3e-8);
}

TEST(SceneReading, a_real_may_be_named_by_a_word_that_the_program_knows) {
  EXPECT_FALSE(parse(good_scene).word("droplet.viscosity"));
  EXPECT_EQ(parse(good_scene).real("droplet.viscosity"), 1e-3);
  const Scene given = parse(std::string(good_scene) + "viscosity = \"water\"");
  EXPECT_EQ(given.word("droplet.viscosity"), "water");
  EXPECT_THROW(given.real("droplet.viscosity"), std::logic_error);
  EXPECT_EQ(parse(given.resolved()).word("droplet.viscosity"), "water");
  EXPECT_EQ(parse(good_scene, {parse_override("droplet.viscosity=honey")}).word("droplet.viscosity"), "honey");
  EXPECT_EQ(parse(good_scene, {parse_override("droplet.viscosity=2")}).real("droplet.viscosity"), 2);
  EXPECT_NE(parameter_page(table()).find("| 0.001 | Pa s | > 0, or \"water\" or \"honey\" |"), std::string::npos);
}

TEST(SceneReading, words_need_no_quotes_on_the_command_line) {
  EXPECT_EQ(parse(good_scene, {parse_override("contact.law=cundall-strack")}).choice("contact.law"), "cundall-strack");
  EXPECT_EQ(parse(good_scene, {parse_override("contact.law=\"jkr\"")}).choice("contact.law"), "jkr");
  EXPECT_EQ(parse(good_scene, {parse_override("run.title=a = b")}).text("run.title"), "a = b");
}

TEST(SceneReading, asking_for_the_undeclared_or_another_type_is_our_error) {
  const Scene scene = parse(good_scene);
  EXPECT_THROW(scene.real("particle.colour"), std::logic_error);
  EXPECT_THROW(scene.integer("particle.radius"), std::logic_error);
}

TEST(SceneReading, a_declaration_that_contradicts_itself_is_our_error) {
  const ParameterTable twice{
      {"a", "", {Parameter::flag("b", "").by_default(true), Parameter::flag("b", "").optional()}}};
  EXPECT_THROW(Scene::parse("", "x", twice), std::logic_error);
  const ParameterTable outside{{"a", "", {Parameter::real("b", "", "").above(0).by_default(0.0)}}};
  EXPECT_THROW(Scene::parse("", "x", outside), std::logic_error);
  const ParameterTable other_type{{"a", "", {Parameter::flag("b", "").by_default("yes")}}};
  EXPECT_THROW(Scene::parse("", "x", other_type), std::logic_error);
}

TEST(SceneDocuments, the_default_scene_reads_back_to_the_defaults) {
  std::string text = default_scene(table());
  EXPECT_NE(text.find("# radius =   (required)  in m"), std::string::npos) << text;
  EXPECT_NE(text.find("radius = 1e-08  # m"), std::string::npos) << text;
  EXPECT_EQ(parse(text + "\n", {{"droplet.radius", "1e-7", "--set"}}).resolved(),
            parse("", {{"droplet.radius", "1e-7", "--set"}}).resolved());
}

TEST(SceneDocuments, the_resolved_scene_holds_every_value_and_reads_back_to_itself) {
  const Scene scene = parse(good_scene, {parse_override("run.title=\"quote \\\" slash \\\\ line\\nend \\u00e9\"")});
  const Scene again = parse(scene.resolved());
  EXPECT_EQ(again.resolved(), scene.resolved());
  EXPECT_EQ(again.text("run.title"), "quote \" slash \\ line\nend \xc3\xa9");
  for (const char* key : {"particle.radius", "particle.number", "contact.law", "run.frames", "droplet.radius"})
    EXPECT_NE(again.where(key), "default") << key;
}

TEST(SceneDocuments, doubles_survive_the_resolved_text_to_the_last_bit) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    const double x = std::fabs(std::bit_cast<double>(random()));
    if (!std::isfinite(x) || x == 0) continue;
    const Scene scene = parse("droplet.radius = " + toml_text(x));
    const Scene again = parse(scene.resolved());
    ASSERT_EQ(std::bit_cast<std::uint64_t>(again.real("droplet.radius")), std::bit_cast<std::uint64_t>(x)) << x;
  }
}

TEST(SceneDocuments, the_reference_page_names_key_default_unit_range_and_meaning) {
  const std::string page = parameter_page(table());
  EXPECT_NE(page.find("## `[material]`"), std::string::npos);
  EXPECT_NE(page.find("| `particle.radius` | 1e-08 | m | > 0 | Radius a |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `material.poisson_ratio` | 0.5 |  | > -1 and <= 0.5 |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `droplet.radius` | required | m |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `particle.number` | not set |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `contact.law` | \"jkr\" |  | jkr or cundall-strack |"), std::string::npos) << page;
}

TEST(SceneFuzz, mutated_scenes_are_read_or_refused_but_never_crash) {
  const std::string seed_text = default_scene(table()) + "\n" + good_scene;
  const std::string fixed = "\n[droplet]\nradius = 1e-7\n";
  const std::string pieces[] = {
      "[",       "]",     "=", "\"",   "'''",  "{",     "}",  "#",          "\n",       ".",      "inf",
      "nan",     "1e999", "-", "\x80", "\xff", "[[x]]", "0x", "1979-05-27", "particle", "radius", std::string(300, '['),
      "\\u0000", ","};
  std::mt19937_64 random(20221);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int read = 0, refused = 0;
  for (int round = 0; round < 6000; ++round) {
    std::string text = round % 3 == 0   ? seed_text
                       : round % 3 == 1 ? std::string(good_scene)
                                        : default_scene(table()) + fixed;
    for (std::size_t edits = below(4); edits > 0 && !text.empty(); --edits) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text.erase(at, 1 + below(8));
          break;
        case 1:
          text.insert(at, pieces[below(std::size(pieces))]);
          break;
        case 2:
          text[at] = static_cast<char>(random());
          break;
        default:
          text.insert(below(text.size()), text.substr(at, below(40)));
          break;
      }
    }
    try {
      const Scene scene = parse(text);
      ++read;
      ASSERT_EQ(parse(scene.resolved()).resolved(), scene.resolved()) << text;
    } catch (const InputError& error) {
      ++refused;
      ASSERT_TRUE(std::string(error.what()).starts_with("drying.toml")) << error.what();
    }
  }
  EXPECT_GT(read, 500);  // else the mutations are so rough that the checks behind the parser are never reached
  EXPECT_GT(refused, 500);
}
