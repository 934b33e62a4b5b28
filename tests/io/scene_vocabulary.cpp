// Lists, repeated sections, former names, and values that a scene takes from a file.
#include <gtest/gtest.h>

#include "common/io/parameters.hpp"

namespace crumble {
namespace {

const ParameterTable& table() {
  static const ParameterTable t{
      {"fluid",
       "The fluid.",
       {Parameter::real("viscosity", "Pa s", "Viscosity").above(0).by_default(1e-3).formerly("liquid.viscosity")}},
      {"output",
       "The file.",
       {Parameter::list("theta", "", "Frames").above(0).below(1).optional().formerly("output.times")}},
      {"protocol", "The protocol.", {Parameter::flag("scaled", "Scaled").by_default(true)}},
      {"protocol.stage",
       "A stage.",
       {Parameter::choice("kind", {"rest", "ramp"}, "Which"),
        Parameter::real("rate", "Pa s-1", "How fast").above(0).optional()},
       true,
       {"protocol.stages"}}};
  return t;
}

std::string refusal(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    Scene::parse(text, "s.toml", table(), overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SceneVocabulary, AFormerNameIsAnErrorThatSaysTheNewOneAndTheLine) {
  EXPECT_EQ(refusal("\n[liquid]\nviscosity = 1.0\n"), "s.toml:3: 'liquid.viscosity' is now called 'fluid.viscosity'");
  EXPECT_EQ(refusal("[protocol]\nstages = \"rest 1\"\n"),
            "s.toml:2: 'protocol.stages' is now called '[[protocol.stage]]'");
  EXPECT_EQ(refusal("", {parse_override("liquid.viscosity=1")}),
            "--set: 'liquid.viscosity' is now called 'fluid.viscosity'");
  EXPECT_NE(refusal("[liquid]\ncolour = 1\n").find("unknown key 'liquid.colour'"), std::string::npos);
}

TEST(SceneVocabulary, AStoredSceneOfAnEarlierVersionIsUnderstood) {
  const Scene s = Scene::parse_stored(
      "[liquid]\nviscosity = 2.0\n[output]\ntimes = \"0.2, 0.4\"\n[protocol]\nstages = \"rest 1\"\n", "old.h5",
      table());
  EXPECT_EQ(s.real("fluid.viscosity"), 2);
  EXPECT_FALSE(s.is_set("output.theta"));  // has another form now
  EXPECT_EQ(s.count("protocol.stage"), 0u);
}

TEST(SceneVocabulary, ListsAreReadCheckedAndWritten) {
  const Scene s = Scene::parse("[output]\ntheta = [0.25, 0.5]\n", "s.toml", table());
  EXPECT_EQ(s.list("output.theta"), (std::vector<double>{0.25, 0.5}));
  EXPECT_NE(s.resolved().find("theta = [0.25, 0.5]\n"), std::string::npos);
  EXPECT_EQ(Scene::parse("", "s.toml", table(), {parse_override("output.theta=[0.5]")}).list("output.theta").size(),
            1u);
  EXPECT_EQ(refusal("[output]\ntheta = [0.5, 1]\n"), "s.toml:2: output.theta = [0.5, 1.0]: 1.0 must be > 0 and < 1");
  for (const char* wrong : {"\"0.2, 0.4\"", "0.2", "[\"a\"]", "[[0.2]]", "[true]"})
    EXPECT_NE(refusal(std::string("[output]\ntheta = ") + wrong + "\n").find("must be a list of numbers"),
              std::string::npos)
        << wrong;
}

TEST(SceneVocabulary, RepeatedSectionsKeepTheirOrderAndReadBack) {
  const std::string text = "[[protocol.stage]]\nkind = \"rest\"\n[[protocol.stage]]\nkind = \"ramp\"\nrate = 5\n";
  const Scene s = Scene::parse(text, "s.toml", table());
  ASSERT_EQ(s.count("protocol.stage"), 2u);
  EXPECT_EQ(s.choice("protocol.stage[0].kind"), "rest");
  EXPECT_EQ(s.real("protocol.stage[1].rate"), 5);
  const Scene again = Scene::parse(s.resolved(), "again.toml", table());
  EXPECT_EQ(again.resolved(), s.resolved());
  EXPECT_EQ(again.keys(), s.keys());
  const Scene other =
      Scene::parse(text, "s.toml", table(), {parse_override("protocol.stage=[{kind=\"ramp\", rate=7}]")});
  ASSERT_EQ(other.count("protocol.stage"), 1u);
  EXPECT_EQ(other.real("protocol.stage[0].rate"), 7);
}

TEST(SceneVocabulary, MistakesInARepeatedSectionNameItsKeyAndLine) {
  EXPECT_EQ(refusal("[[protocol.stage]]\nkind = \"ramp\"\nraet = 5\n"),
            "s.toml:3: unknown key 'protocol.stage[0].raet'; did you mean 'protocol.stage[0].rate'?");
  EXPECT_NE(refusal("[[protocol.stage]]\nrate = 5\n").find("'protocol.stage[0].kind' is missing"), std::string::npos);
  EXPECT_NE(refusal("[protocol.stage]\nkind = \"rest\"\n").find("write [[protocol.stage]]"), std::string::npos);
  EXPECT_NE(refusal("[protocol]\nstage = 3\n").find("write [[protocol.stage]]"), std::string::npos);
}

TEST(SceneVocabulary, DefaultsOfARepeatedSectionAreCommentsThatReadBack) {
  const Scene s = Scene::parse(default_scene(table()), "defaults.toml", table());
  EXPECT_EQ(s.count("protocol.stage"), 0u);
  EXPECT_NE(default_scene(table()).find("# [[protocol.stage]]\n"), std::string::npos);
}

TEST(SceneVocabulary, TheScenesValueWinsOverTheFilesAndTheFilesOverTheDefault) {
  Scene given = Scene::parse("[fluid]\nviscosity = 2\n", "s.toml", table());
  given.inherit("fluid.viscosity", 3.0, "a.h5");
  EXPECT_EQ(given.real("fluid.viscosity"), 2);
  EXPECT_EQ(given.origin("fluid.viscosity"), Scene::Origin::given);
  Scene silent = Scene::parse("", "s.toml", table());
  EXPECT_EQ(silent.origin("fluid.viscosity"), Scene::Origin::by_default);
  silent.inherit("fluid.viscosity", 3.0, "a.h5");
  EXPECT_EQ(silent.real("fluid.viscosity"), 3);
  EXPECT_EQ(silent.where("fluid.viscosity"), "a.h5");
  EXPECT_NE(silent.resolved().find("viscosity = 3.0"), std::string::npos);
  EXPECT_THROW(silent.inherit("fluid.viscosity", -1.0, "a.h5"), InputError);
}

}  // namespace
}  // namespace crumble
