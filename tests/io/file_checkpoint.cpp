// A checkpoint comes back to the bit, and only to the program, version and scene that it belongs to.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <fstream>
#include <limits>

#include "common/io/checkpoint.hpp"
#include "common/io/file_errors.hpp"
#include "common/io/hdf5.hpp"
#include "tests/io/sample_agglomerate.hpp"

namespace crumble::test {
namespace {

const CheckpointOwner owner{"dryer", "0.1.0", "[particle]\nradius = 1e-8\ncount = 115\n"};

std::string refusal(const std::filesystem::path& path, const CheckpointOwner& other) {
  try {
    load_checkpoint(path, other);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Checkpoint, ComesBackToTheBit) {
  const Folder folder;
  SavedState saved;
  saved.reals["odd"] = {0.1, -0.0, 5e-324, std::numeric_limits<double>::max(), 1 / 3.0, NAN, -INFINITY};
  saved.reals["none"] = {};
  saved.integers["counts"] = {0, -1, INT64_MAX, INT64_MIN};
  save_checkpoint(folder / "a.h5.checkpoint", owner, saved);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.checkpoint.tmp"));
  const SavedState loaded = load_checkpoint(folder / "a.h5.checkpoint", owner);
  ASSERT_EQ(loaded.reals.at("odd").size(), saved.reals["odd"].size());
  for (std::size_t k = 0; k < loaded.reals.at("odd").size(); ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(loaded.reals.at("odd")[k]),
              std::bit_cast<std::uint64_t>(saved.reals["odd"][k]));
  EXPECT_TRUE(loaded.reals.at("none").empty());
  EXPECT_EQ(loaded.integers.at("counts"), saved.integers["counts"]);
  EXPECT_FALSE(loaded.reals.contains("counts"));
}

TEST(Checkpoint, OfAnotherProgramVersionOrSceneIsRefusedByName) {
  const Folder folder;
  const auto path = folder / "a.h5.checkpoint";
  save_checkpoint(path, owner, {});
  EXPECT_NE(refusal(path, {"breaker", owner.version, owner.scene}).find("a checkpoint of dryer, not of breaker"),
            std::string::npos);
  EXPECT_NE(refusal(path, {owner.program, "0.2.0", owner.scene}).find("made by version 0.1.0, this is 0.2.0"),
            std::string::npos);
  EXPECT_NE(refusal(path, {owner.program, owner.version, "[particle]\nradius = 1e-8\ncount = 85\n"})
                .find("'count = 115' then, 'count = 85' now"),
            std::string::npos);
  EXPECT_EQ(refusal(path, owner), "accepted");
}

TEST(Checkpoint, ThatIsNoneIsAnError) {
  const Folder folder;
  EXPECT_THROW(load_checkpoint(folder / "none", owner), OpenError);
  std::ofstream(folder / "text") << "not a checkpoint";
  EXPECT_THROW(load_checkpoint(folder / "text", owner), OpenError);
  write_sample(folder / "a.h5", 1);
  EXPECT_THROW(load_checkpoint(folder / "a.h5", owner), ContentError);
  save_checkpoint(folder / "b", owner, {});
  auto file = hdf5::File::modify(folder / "b");
  const std::array<double, 1> one{1};
  file.group("/restart").set_attribute<double>("program", one);
  file.close();
  EXPECT_THROW(load_checkpoint(folder / "b", owner), ContentError);
}

}  // namespace
}  // namespace crumble::test
