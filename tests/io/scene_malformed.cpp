// Malformed scenes, each with the message that a person gets.
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/io/scene_table.hpp"
#include "tests/temporary_folder.hpp"

using namespace crumble;
using crumble::testing::good_scene;
using crumble::testing::table;

namespace {

struct Malformed {
  const char* name;
  std::string text;     // after the good scene has been read; replaces it if it starts with '!'
  std::string set;      // argument of --set, if any
  std::string message;  // the whole of it, or its end after "..."
};

std::string message_of(const Malformed& scene) {
  const std::string text = scene.text.starts_with('!') ? scene.text.substr(1) : good_scene + scene.text;
  try {
    std::vector<Override> overrides;
    if (!scene.set.empty()) overrides.push_back(parse_override(scene.set));
    Scene::parse(text, "drying.toml", table(), overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no complaint)";
}

// Lines are counted in the good scene (6 lines) plus the text of the case, which begins on line 7.
const Malformed cases[] = {
    {"misspelt_key", "![droplet]\nradius = 1e-7\n[particle]\nraduis = 1e-8", "",
     "drying.toml:4: unknown key 'particle.raduis'; did you mean 'particle.radius'?"},
    {"misspelt_section", "[materail]\npoisson_ratio = 0.5", "",
     "drying.toml:7: unknown section 'materail'; did you mean 'material'?"},
    {"key_in_the_wrong_section", "density = 1000", "",
     "drying.toml:7: unknown key 'droplet.density'; did you mean 'particle.density'?"},
    {"key_without_section", "!frames = 10\n[droplet]\nradius = 1e-7", "",
     "drying.toml:1: unknown key 'frames'; did you mean 'run.frames'?"},
    {"key_like_no_other", "viscosity_of_the_air = 1", "", "drying.toml:7: unknown key 'droplet.viscosity_of_the_air'"},
    {"section_like_no_other", "[weather]\nrain = true", "",
     "drying.toml:7: unknown section 'weather'; the sections are particle, material, contact, droplet, run"},
    {"capital_letters", "![Droplet]\nradius = 1e-7\n[droplet]\nradius = 1e-7", "",
     "drying.toml:1: unknown section 'Droplet'; did you mean 'droplet'?"},
    {"text_for_a_number", "![droplet]\nradius = \"215 nm\"", "",
     "drying.toml:2: droplet.radius = \"215 nm\": must be a number > 0 in m"},
    {"unit_behind_the_number", "![droplet]\nradius = 215 nm", "",
     "...drying.toml:2: cannot read 'radius = 215 nm' (column 14): "},
    {"number_for_a_word", "[contact]\nlaw = 1", "",
     "drying.toml:8: contact.law = 1: must be one of jkr, cundall-strack"},
    {"unknown_choice", "[contact]\nlaw = \"jrk\"", "",
     "drying.toml:8: contact.law = \"jrk\": must be one of jkr, cundall-strack; did you mean 'jkr'?"},
    {"unknown_word_for_a_number", "viscosity = \"watr\"", "",
     "drying.toml:7: droplet.viscosity = \"watr\": must be a number > 0 in Pa s, or \"water\" or \"honey\"; did you "
     "mean "
     "'water'?"},
    {"flag_for_a_number_or_word", "viscosity = true", "",
     "drying.toml:7: droplet.viscosity = true: must be a number > 0 in Pa s, or \"water\" or \"honey\""},
    {"negative_number_or_word", "", "droplet.viscosity=-1", "--set: droplet.viscosity = -1: must be > 0 Pa s"},
    {"number_for_a_flag", "[contact]\nrolling = 1", "", "drying.toml:8: contact.rolling = 1: must be true or false"},
    {"fraction_for_a_count", "[run]\nframes = 10.5", "",
     "drying.toml:8: run.frames = 10.5: must be a whole number 2 to 10000"},
    {"exponent_for_a_count", "[run]\nframes = 1e3", "",
     "drying.toml:8: run.frames = 1000.0: must be a whole number 2 to 10000"},
    {"too_small", "![droplet]\nradius = 0", "", "drying.toml:2: droplet.radius = 0: must be > 0 m"},
    {"negative", "![droplet]\nradius = -1e-7", "", "drying.toml:2: droplet.radius = -1e-07: must be > 0 m"},
    {"beyond_a_closed_end", "[material]\npoisson_ratio = 0.51", "",
     "drying.toml:8: material.poisson_ratio = 0.51: must be > -1 and <= 0.5"},
    {"on_an_open_end", "[material]\npoisson_ratio = -1", "",
     "drying.toml:8: material.poisson_ratio = -1: must be > -1 and <= 0.5"},
    {"count_out_of_range", "[run]\nframes = 1", "", "drying.toml:8: run.frames = 1: must be 2 to 10000"},
    {"count_beyond_64_bits", "[run]\nseed = 99999999999999999999", "",
     "drying.toml:8: cannot read 'seed = 99999999999999999999' (column 28): '99999999999999999999' is not "
     "representable in "
     "64 bits"},
    {"infinite", "![droplet]\nradius = inf", "",
     "drying.toml:2: droplet.radius = inf: is not finite; it must be a number > 0 in m"},
    {"not_a_number", "![droplet]\nradius = nan", "",
     "drying.toml:2: droplet.radius = nan: is not finite; it must be a number > 0 in m"},
    {"beyond_double", "![droplet]\nradius = 1e999", "", "...drying.toml:2: "},
    {"array_for_a_number", "![droplet]\nradius = [1e-7, 2e-7]", "",
     "drying.toml:2: droplet.radius = [1e-07, 2e-07]: must be a number > 0 in m"},
    {"date_for_a_number", "![droplet]\nradius = 1979-05-27", "",
     "drying.toml:2: droplet.radius = a date or time: must be a number > 0 in m"},
    {"table_for_a_number", "![droplet.radius]\nvalue = 1", "",
     "drying.toml:1: droplet.radius = a table: must be a number > 0 in m"},
    {"number_for_a_section", "!droplet = 3", "",
     "drying.toml:1: 'droplet' is a section, not a key: write [droplet] and its keys below\n"
     "drying.toml: 'droplet.radius' is missing; it must be a number > 0 in m (Radius R0 at the start)"},
    {"array_of_tables_for_a_section", "![[droplet]]\nradius = 1e-7", "",
     "drying.toml:1: 'droplet' is a section, not a key: write [droplet] and its keys below\n"
     "drying.toml: 'droplet.radius' is missing; it must be a number > 0 in m (Radius R0 at the start)"},
    {"required_is_missing", "!", "",
     "drying.toml: 'droplet.radius' is missing; it must be a number > 0 in m (Radius R0 at the start)"},
    {"two_errors_at_once", "![droplet]\nradius = -1\n[particle]\nnumbr = 3", "",
     "drying.toml:2: droplet.radius = -1: must be > 0 m\n"
     "drying.toml:4: unknown key 'particle.numbr'; did you mean 'particle.number'?"},
    {"duplicate_key", "radius = 3e-7", "",
     "drying.toml:7: cannot read 'radius = 3e-7' (column 10): cannot redefine existing floating-point 'radius'"},
    {"duplicate_section", "[particle]\nnumber = 3", "", "...drying.toml:7: cannot read '[particle]' (column 1): "},
    {"no_value", "![droplet]\nradius =\n", "", "...drying.toml:2: cannot read 'radius =' (column 9): "},
    {"no_equals", "![droplet]\nradius 1e-7\n", "", "...drying.toml:2: cannot read 'radius 1e-7' (column 8): "},
    {"open_quote", "[run]\ntitle = \"granule\n", "", "...drying.toml:8: cannot read 'title = \"granule' "},
    {"open_bracket", "![droplet\nradius = 1e-7", "", "...drying.toml:1: cannot read '[droplet' (column 9): "},
    {"bad_utf8", "[run]\ntitle = \"\xff\xfe\"\n", "", "...drying.toml:8: "},
    {"binary_file", std::string("!\x89HDF\r\n\x1a\n\0\0\0", 12), "",
     "drying.toml: this is a binary file; a scene is a TOML text file"},
    {"huge_file", "!#" + std::string(1 << 20, 'x'), "", "drying.toml: larger than 1 MiB; this is not a scene"},
    {"deep_nesting", "!x = " + std::string(5000, '['), "", "...drying.toml:1: "},
    {"control_characters_in_a_key", "\"a\\nb\\u001b\" = 1", "", "drying.toml:7: unknown key 'droplet.a?b?'"},
    {"set_without_equals", "", "particle.radius", "--set: 'particle.radius' must have the form section.key=value"},
    {"set_without_value", "", "particle.radius=", "--set: 'particle.radius=' must have the form section.key=value"},
    {"set_unknown_key", "", "particle.raduis=1e-8",
     "--set: unknown key 'particle.raduis'; did you mean 'particle.radius'?"},
    {"set_wrong_type", "", "particle.radius=small", "--set: particle.radius = small: must be a number > 0 in m"},
    {"set_out_of_range", "", "particle.radius=-1e-8", "--set: particle.radius = -1e-08: must be > 0 m"},
    {"set_two_lines", "", "particle.radius=1e-8\nx=1", "--set: particle.radius = 1e-8?x=1: must be a number > 0 in m"},
    {"set_unknown_choice", "", "contact.law=hertz",
     "--set: contact.law = \"hertz\": must be one of jkr, cundall-strack"},
};

void PrintTo(const Malformed& scene, std::ostream* out) { *out << scene.name; }

class MalformedScene : public ::testing::TestWithParam<Malformed> {};

TEST_P(MalformedScene, is_refused_with_its_own_message) {
  const std::string message = message_of(GetParam()), wanted = GetParam().message;
  if (wanted.starts_with("..."))
    EXPECT_TRUE(message.starts_with(wanted.substr(3)) && message.size() > wanted.size()) << message;
  else
    EXPECT_EQ(message, wanted);
}

INSTANTIATE_TEST_SUITE_P(all, MalformedScene, ::testing::ValuesIn(cases),
                         [](const auto& each) { return std::string(each.param.name); });

std::string read_message(const std::string& file) {
  try {
    Scene::read(file, table());
  } catch (const InputError& error) {
    return error.what();
  }
  return "(no complaint)";
}

TEST(SceneFile, that_is_not_there_is_named) {
  EXPECT_EQ(read_message("/nowhere/drying.toml"),
            "/nowhere/drying.toml: cannot read the scene: No such file or directory");
}

TEST(SceneFile, that_is_a_folder_is_named) {
  EXPECT_EQ(read_message("/usr"), "/usr: cannot read the scene: Is a directory");
}

TEST(SceneFile, is_read_as_it_stands) {
  const test::Folder folder;
  const auto file = folder / "scene.toml";
  std::ofstream(file, std::ios::binary) << good_scene;
  const Scene scene = Scene::read(file.string(), table());
  EXPECT_EQ(scene.given(), good_scene);
  EXPECT_EQ(scene.where("droplet.radius"), file.string() + ":6");
}

}  // namespace
