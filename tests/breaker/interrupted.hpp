// A breakup that is interrupted and goes on from its checkpoint, beside the one that was not.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "breaker/breakup_checkpoint.hpp"
#include "tests/temporary_folder.hpp"

namespace crumble::breaker::testing {

// steps: in all; broken: the first after which the granule is in pieces, 0: it never was.
struct Whole {
  int steps = 0;
  int broken = 0;
};

inline Whole to_the_end(BreakupRun& run) {
  Whole whole;
  for (; !run.finished(); ++whole.steps) {
    run.step();
    if (!whole.broken && run.breakup().severed) whole.broken = whole.steps + 1;
  }
  return whole;
}

inline void expect_equal(const Frame& f, const Frame& g) {
  EXPECT_EQ(f.time, g.time);
  EXPECT_EQ(f.step, g.step);
  EXPECT_EQ(f.position, g.position);
  ASSERT_EQ(f.contacts.size(), g.contacts.size());
  for (std::size_t c = 0; c < f.contacts.size(); ++c) {
    EXPECT_EQ(f.contacts[c].gap, g.contacts[c].gap);
    EXPECT_EQ(f.contacts[c].rolling, g.contacts[c].rolling);
  }
}

// Before, in and after breakup.
inline void expect_to_go_on_to_the_same_bits(const BreakerScene& scene, const Agglomerate& start, BreakupRun& whole,
                                             const Whole& when) {
  const test::Folder folder;
  const std::string output = folder.file("out.h5");
  for (const int stop : {when.broken / 2 + 1, when.broken + 1, (when.broken + when.steps) / 2}) {
    BreakupRun first(scene, start, 1);
    for (int k = 0; k < stop; ++k) first.step();
    const CheckpointOwner owner{"breaker", "1", "scene"};
    Progression progression{.next_sample = 5, .companion = 7};
    const OutputCheckpoint checkpoint(output, owner);
    checkpoint.write(checkpoint.collect([&](SavedFields& f) {
      FrameLog::Mark().fields(f.in("frames"));
      save_breakup(f, progression, save(whole), first);
    }));
    const OutputCheckpoint found(output, owner);
    ASSERT_TRUE(found.found());
    SavedBreakup saved = saved_breakup(found);
    EXPECT_EQ(saved.progression.companion, 7);
    EXPECT_EQ(field_names(saved.companion), field_names(save(whole)));
    BreakupRun second(scene, start, 1);
    resume(second, found, std::move(saved.run));
    std::filesystem::remove(found.path());
    expect_equal(first.laboratory(), second.laboratory());
    while (!second.finished()) second.step();
    expect_equal(whole.laboratory(), second.laboratory());
    EXPECT_EQ(whole.statistics().steps, second.statistics().steps);
    EXPECT_EQ(whole.breakup().severed, second.breakup().severed);
    EXPECT_EQ(whole.breakup().fragments, second.breakup().fragments);
    EXPECT_EQ(whole.events().size(), second.events().size());
  }
}

}  // namespace crumble::breaker::testing
