// A checkpoint comes back to the bit, and only to the program, version and scene that it belongs to.
#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <iterator>
#include <limits>

#include "common/io/agglomerate_reader.hpp"
#include "common/io/checkpoint.hpp"
#include "common/io/file_errors.hpp"
#include "common/io/frame_log.hpp"
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
  EXPECT_THROW(load_checkpoint(folder / "text", owner), ContentError);
  write_sample(folder / "a.h5", 1);
  EXPECT_THROW(load_checkpoint(folder / "a.h5", owner), ContentError);
}

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
}

TEST(Checkpoint, OfWhichAnyByteIsChangedOrLostIsRefused) {
  const Folder folder;
  const auto path = folder / "a.h5.checkpoint";
  SavedState saved;
  saved.reals["some"] = {1, 2, 3};
  saved.integers["count"] = {4};
  save_checkpoint(path, owner, saved);
  const std::string whole = content(path);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    std::string changed = whole;
    changed[k] = static_cast<char>(changed[k] ^ (1 << k % 8));
    write(path, changed);
    EXPECT_THROW(load_checkpoint(path, owner), ContentError) << k;
    write(path, whole.substr(0, k));
    EXPECT_THROW(load_checkpoint(path, owner), ContentError) << k;
  }
  write(path, whole + "x");
  EXPECT_THROW(load_checkpoint(path, owner), ContentError);
}

TEST(Checkpoint, KnowsWhatAKilledRunHasLeft) {
  const Folder folder;
  const std::string output = (folder / "a.h5").string();
  for (const char* ending : {".tmp", ".frames", ".checkpoint.tmp"}) write(output + ending, "half");
  const std::string words = OutputCheckpoint(output, owner).leftovers();
  for (const char* ending : {".tmp", ".frames", ".checkpoint.tmp"}) {
    EXPECT_NE(words.find(output + ending), std::string::npos) << words;
    EXPECT_FALSE(std::filesystem::exists(output + ending));
  }
  EXPECT_NE(words.find("begins anew"), std::string::npos) << words;
  EXPECT_EQ(OutputCheckpoint(output, owner).leftovers(), "");
}

TEST(Checkpoint, IsThatOfTheSceneWhateverItsInterval) {
  const Folder folder;
  const std::string output = (folder / "a.h5").string();
  const auto with = [&](const std::string& interval) {
    return CheckpointOwner{"dryer", "0.1.0", "[output]\nframes = 5\ncheckpoint_interval = " + interval + "\n[run]\n"};
  };
  const OutputCheckpoint first(output, with("60"));
  first.write(first.collect([](SavedFields&) {}));
  EXPECT_TRUE(OutputCheckpoint(output, with("10")).found());
  EXPECT_THROW(OutputCheckpoint(output, owner), InputError);
}

constexpr std::size_t size = sample_size;

void append(FrameLog& log, int first, int end) {
  for (int t = first; t < end; ++t) {
    log.append(sample_frame(size, 10 + 7 * t), sample_observables(t));
    for (int k = 0; k < 5; ++k) log.sample(10 * t + k, 1e-9 * (10 * t + k), {{"front_speed", "m s-1", 0.5 * k}});
  }
}

void write_file(const FrameLog& log, const std::filesystem::path& path) {
  AgglomerateWriter writer(path, sample_particles(size), sample_description());
  log.write_to(writer);
  writer.finish("drying");
}

TEST(FrameLog, GoesOnFromItsMarkAsIfNeverStopped) {
  const Folder folder;
  FrameLog whole(folder / "whole.h5");
  append(whole, 0, 4);
  write_file(whole, folder / "whole.h5");
  FrameLog::Mark mark;
  {
    FrameLog first(folder / "a.h5");
    append(first, 0, 2);
    mark = first.mark();
    append(first, 2, 3);  // lost, and made again
    first.keep();
  }
  FrameLog second(folder / "a.h5", mark);
  append(second, 2, 4);
  EXPECT_EQ(second.mark().sha256, whole.mark().sha256);
  write_file(second, folder / "a.h5");
  const AgglomerateReader expected(folder / "whole.h5"), found(folder / "a.h5");
  ASSERT_EQ(found.frame_count(), 4u);
  for (std::size_t t = 0; t < 4; ++t) {
    const Frame f = found.frame(t), g = expected.frame(t);
    EXPECT_EQ(f.step, g.step);
    EXPECT_EQ(f.time, g.time);
    EXPECT_EQ(f.position, g.position);
    EXPECT_EQ(f.torque, g.torque);
    ASSERT_EQ(f.contacts.size(), g.contacts.size());
    for (std::size_t c = 0; c < f.contacts.size(); ++c) EXPECT_EQ(f.contacts[c].rolling, g.contacts[c].rolling);
  }
  for (const auto& name : expected.observable_names())
    EXPECT_EQ(found.observable(name), expected.observable(name)) << name;
}

TEST(FrameLog, OfWhichAnyByteBeforeTheMarkIsChangedIsRefused) {
  const Folder folder;
  const auto path = folder / "a.h5.frames";
  FrameLog::Mark mark;
  {
    FrameLog log(folder / "a.h5");
    log.sample(1, 2, {{"front_speed", "m s-1", 3}});
    mark = log.mark();
    log.sample(4, 5, {{"front_speed", "m s-1", 6}});
    log.keep();
  }
  const std::string whole = content(path);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    std::string changed = whole;
    changed[k] = static_cast<char>(changed[k] ^ (1 << k % 8));
    write(path, changed);
    if (k < static_cast<std::size_t>(mark.bytes))
      EXPECT_THROW(FrameLog(folder / "a.h5", mark), ContentError) << k;
    else
      EXPECT_NO_THROW(FrameLog(folder / "a.h5", mark)) << k;
  }
  write(path, whole.substr(0, static_cast<std::size_t>(mark.bytes) - 1));
  EXPECT_THROW(FrameLog(folder / "a.h5", mark), ContentError);
  std::filesystem::remove(path);
  EXPECT_THROW(FrameLog(folder / "a.h5", mark), ContentError);
}

TEST(FrameLog, RefusesANumberThatIsNotFiniteWhereItIsMade) {
  const Folder folder;
  FrameLog log(folder / "a.h5");
  EXPECT_THROW(log.sample(1, 2, {{"front_speed", "m s-1", NAN}}), ContentError);
  EXPECT_EQ(log.mark().records, 0);
}

TEST(FrameLog, OfARunWithoutACheckpointGoesWithIt) {
  const Folder folder;
  { FrameLog log(folder / "a.h5"); }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.frames"));
}

}  // namespace
}  // namespace crumble::test
