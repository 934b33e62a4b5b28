#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/io/command_line.hpp"
#include "tests/io/scene_table.hpp"
#include "tests/temporary_folder.hpp"

using namespace crumble;

namespace {

ProgramDescription program() {
  return {"dryer",         "Dries a droplet.",       {}, {{"dryer hollow.toml -o hollow.h5", "dry one granule"}},
          "dryer 0.1.0\n", crumble::testing::table()};
}

CommandLine parse(const std::vector<const char*>& arguments, const ProgramDescription& p = program()) {
  std::vector<const char*> argv{p.name.c_str()};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  return parse_command_line(p, static_cast<int>(argv.size()), argv.data());
}

std::string first_line_of_refusal(const std::vector<const char*>& arguments, const ProgramDescription& p = program()) {
  try {
    parse(arguments, p);
  } catch (const InputError& error) {
    const std::string text = error.what();
    return text.substr(0, text.find('\n'));
  }
  return "(accepted)";
}

}  // namespace

TEST(CommandLine, is_read_in_any_order) {
  const CommandLine c = parse({"--threads", "2", "--set", "particle.radius=2e-8", "hollow.toml", "--set=run.frames=3",
                               "-o", "hollow.h5", "--quiet", "--seed", "7", "--report", "hollow.json"});
  EXPECT_EQ(c.scene, "hollow.toml");
  EXPECT_EQ(c.output, "hollow.h5");
  EXPECT_EQ(c.report, "hollow.json");
  EXPECT_EQ(c.threads, 2);
  EXPECT_TRUE(c.quiet);
  EXPECT_FALSE(c.check);
  EXPECT_FALSE(c.answer);
  ASSERT_EQ(c.overrides.size(), 3u);
  EXPECT_EQ(c.overrides[0].key + "=" + c.overrides[0].value, "particle.radius=2e-8");
  EXPECT_EQ(c.overrides[1].key + "=" + c.overrides[1].value, "run.frames=3");
  EXPECT_EQ(c.overrides[2].key + "=" + c.overrides[2].value + c.overrides[2].origin, "run.seed=7--seed");
}

TEST(CommandLine, a_check_needs_no_output) { EXPECT_TRUE(parse({"hollow.toml", "--check"}).check); }

TEST(CommandLine, further_inputs_stand_behind_the_scene) {
  ProgramDescription p = program();
  p.inputs = {{"AGGLOMERATE.h5", "the agglomerate to load"}};
  EXPECT_EQ(parse({"flow.toml", "hollow.h5", "-o", "x.h5"}, p).inputs, std::vector<std::string>{"hollow.h5"});
  EXPECT_EQ(first_line_of_refusal({"flow.toml", "-o", "x.h5"}, p),
            "dryer: 1 file name is given, wanted: SCENE.toml AGGLOMERATE.h5");
}

TEST(CommandLine, help_teaches_examples_and_exit_codes) {
  const std::string help = *parse({"--help"}).answer;
  for (const char* wanted : {"Dries a droplet.", "Usage: dryer SCENE.toml -o FILE.h5", "dryer hollow.toml -o hollow.h5",
                             "Exit codes:", "130", "--print-defaults", "--set section.key=value", "--seed N"})
    EXPECT_NE(help.find(wanted), std::string::npos) << wanted << " is not in\n" << help;
}

TEST(CommandLine, answers_need_no_scene) {
  EXPECT_EQ(*parse({"--version"}).answer, "dryer 0.1.0\n");
  EXPECT_TRUE(parse({"--print-reference"}).answer->starts_with("# Parameters of `dryer`\n"));
  EXPECT_EQ(*parse({"--print-defaults"}).answer, default_scene(crumble::testing::table()));
}

TEST(CommandLine, seed_is_offered_only_where_it_is_declared) {
  ProgramDescription p = program();
  p.parameters = {};
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "b.h5", "--seed", "1"}, p),
            "dryer: unknown option '--seed'; did you mean '--set'?");
}

TEST(CommandLine, restart_is_offered_only_where_checkpoints_are_kept) {
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "b.h5", "--restart"}),
            "dryer: unknown option '--restart'; did you mean '--report'?");
  ProgramDescription p = program();
  p.keeps_checkpoint = true;
  EXPECT_TRUE(parse({"a.toml", "-o", "b.h5", "--restart"}, p).restart);
  EXPECT_FALSE(parse({"a.toml", "-o", "b.h5"}, p).restart);
}

TEST(CommandLine, each_misuse_has_its_own_message) {
  EXPECT_EQ(first_line_of_refusal({}), "dryer: 0 file names are given, wanted: SCENE.toml");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "b.toml", "-o", "c.h5"}),
            "dryer: 2 file names are given, wanted: SCENE.toml");
  EXPECT_EQ(first_line_of_refusal({"a.toml"}), "dryer: -o FILE.h5 is missing");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o"}), "dryer: --output: 1 required FILE.h5 missing");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "b.h5", "--sede", "1"}),
            "dryer: unknown option '--sede'; did you mean '--seed'?");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "b.h5", "-z"}), "dryer: unknown option '-z'");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "b.h5", "--seed", "-1"}),
            "dryer: --seed -1: must be a whole number 0 to 9223372036854775807");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "b.h5", "--seed", "1.5"}),
            "dryer: --seed 1.5: must be a whole number 0 to 9223372036854775807");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "b.h5", "--threads", "0"}),
            "dryer: --threads 0: must be a whole number 1 to 1024");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "b.h5", "--set", "radius"}),
            "--set: 'radius' must have the form section.key=value");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "/nowhere/b.h5"}),
            "dryer: -o /nowhere/b.h5: there is no folder '/nowhere'");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "/usr"}), "dryer: -o /usr: this is a folder");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "b.h5", "--report", "/nowhere/b.json"}),
            "dryer: --report /nowhere/b.json: there is no folder '/nowhere'");
  EXPECT_EQ(first_line_of_refusal({"a.toml", "-o", "b.h5", "--report", "b.h5"}),
            "dryer: -o b.h5 and --report b.h5 are the same file");
}

TEST(CommandLine, an_output_may_not_overwrite_an_input) {
  const test::Folder folder;
  const std::string scene = folder.file("overwritten.toml");
  std::ofstream(scene) << "x";
  const std::string same = scene.substr(0, scene.rfind('/')) + "/./overwritten.toml";
  EXPECT_EQ(first_line_of_refusal({scene.c_str(), "-o", same.c_str()}),
            "dryer: -o " + same + ": would overwrite the input '" + scene + "'");
}
