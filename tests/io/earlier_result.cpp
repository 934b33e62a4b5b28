// What already stands where a program is about to write.
#include "common/io/earlier_result.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "common/io/settings.hpp"
#include "tests/io/sample_agglomerate.hpp"

namespace crumble::test {
namespace {

constexpr const char* scene = "[droplet]\nradius = 2.15e-07  # m\n\n[run]\nseed = 1\n";

void write_result(const std::filesystem::path& path, const Provenance& provenance, const std::string& resolved) {
  AgglomerateWriter writer(path, sample_particles(sample_size), {"dryer", provenance, "", resolved});
  writer.append(sample_frame(sample_size, 10), sample_observables(0));
  writer.finish("dry");
}

Provenance by(const std::string& program, const std::string& parent = "", const std::string& sum = "") {
  Provenance p = make_provenance(program, {program}, 1, philox);
  p.parent = parent, p.parent_sha256 = sum;
  return p;
}

std::string refusal(const std::filesystem::path& path, const Provenance& now, const std::string& resolved = scene) {
  try {
    require_no_other_result(path.string(), now, resolved);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(EarlierResult, TheSameSceneMayRunAgain) {
  const Folder folder;
  EXPECT_EQ(refusal(folder / "none.h5", by("dryer")), "");
  write_result(folder / "a.h5", by("dryer"), scene);
  EXPECT_EQ(refusal(folder / "a.h5", by("dryer")), "");
  // The same values in other words.
  EXPECT_EQ(refusal(folder / "a.h5", by("dryer"), "run.seed = 1\n[droplet]\nradius = 215e-9\n"), "");
  // When the run was saved on the way is no part of the result.
  EXPECT_EQ(refusal(folder / "a.h5", by("dryer"), scene + std::string("[output]\ncheckpoint_interval = 5\n")), "");
  std::ofstream(folder / "empty.h5");
  EXPECT_EQ(refusal(folder / "empty.h5", by("dryer")), "");
}

TEST(EarlierResult, AnotherSceneIsRefusedWithWhatDiffersAndTheRemedy) {
  const Folder folder;
  write_result(folder / "a.h5", by("dryer"), scene);
  const std::string text =
      refusal(folder / "a.h5", by("dryer"), "[droplet]\nradius = 3e-07\n[run]\nseed = 1\nframes = 5\n");
  EXPECT_NE(text.find("another scene (droplet.radius = 2.15e-07, here 3e-07; run.frames = not set, here 5)"), text.npos)
      << text;
  EXPECT_NE(text.find("--overwrite"), text.npos);
  EXPECT_NE(refusal(folder / "a.h5", by("breaker")).find("a result of dryer"), text.npos);
}

TEST(EarlierResult, AnotherGranuleIsAnotherNameAndAnotherContent) {
  const Folder folder;
  write_result(folder / "a.h5", by("breaker", "one.h5", "11"), scene);
  EXPECT_EQ(refusal(folder / "a.h5", by("breaker", "one.h5", "22")), "");  // dried anew
  EXPECT_EQ(refusal(folder / "a.h5", by("breaker", "moved.h5", "11")), "");
  const std::string text = refusal(folder / "a.h5", by("breaker", "two.h5", "22"));
  EXPECT_NE(text.find("another granule, "), text.npos) << text;
  EXPECT_NE(text.find("one.h5; "), text.npos) << text;
}

TEST(EarlierResult, AFileThatIsNoResultIsNotReplacedEither) {
  const Folder folder;
  std::ofstream(folder / "thesis.h5") << "do not lose me";
  EXPECT_NE(refusal(folder / "thesis.h5", by("dryer")).find("a file that is no result"), std::string::npos);
}

TEST(Settings, ValuesAreComparedAsNumbersAndSectionsThatRepeatHaveANumber) {
  const Settings a =
      settings_in("[p]\nx = 1.0\n[[p.stage]]\nkind = \"ramp\"\nrate = 5000.0\n[[p.stage]]\nkind = \"rest\"\n");
  EXPECT_EQ(a.at("p.stage[1].kind"),
            settings_in("[[p.stage]]\nkind = \"ramp\"\n[[p.stage]]\nkind = 'rest'").at("p.stage[1].kind"));
  EXPECT_EQ(a.at("p.x"), settings_in("p.x = 1e0").at("p.x"));
  const auto d = differences(a, settings_in("p.x = 2.0"));
  EXPECT_EQ(d.size(), 4u);
  EXPECT_TRUE(settings_in("not a scene").empty());
}

}  // namespace
}  // namespace crumble::test
