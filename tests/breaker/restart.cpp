// A breakup goes on from its checkpoint to the same bits, with one piece and with several, with either integrator.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "breaker/breakup_checkpoint.hpp"
#include "tests/breaker/samples.hpp"
#include "tests/temporary_folder.hpp"

namespace crumble::breaker {
namespace {

using namespace testing;

void expect_equal(const Frame& f, const Frame& g) {
  EXPECT_EQ(f.time, g.time);
  EXPECT_EQ(f.step, g.step);
  EXPECT_EQ(f.position, g.position);
  ASSERT_EQ(f.contacts.size(), g.contacts.size());
  for (std::size_t c = 0; c < f.contacts.size(); ++c) {
    EXPECT_EQ(f.contacts[c].gap, g.contacts[c].gap);
    EXPECT_EQ(f.contacts[c].rolling, g.contacts[c].rolling);
  }
}

class BreakupRestart : public ::testing::TestWithParam<bool> {};

TEST_P(BreakupRestart, ContinuesToTheSameBitsBeforeAndAfterBreakup) {
  const Agglomerate start = cluster(chain(8));
  BreakerScene scene;
  scene.model = elongation(Rung::fts);
  scene.protocol = Protocol({{0, 2e7}});
  scene.largest_stress = 1e5;
  if (GetParam()) scene.integrator = IntegratorKind::explicit_euler;
  scene.tolerance = 0.03;
  scene.until_stable = true;
  scene.stable_strain = 1;
  BreakupRun whole(scene, start, 1);
  int steps = 0, broken = 0;
  for (; !whole.finished(); ++steps) {
    whole.step();
    if (!broken && whole.breakup().severed) broken = steps + 1;
  }
  ASSERT_GT(broken, 0);
  scene.rigid_strength = whole.breakup().severed.value().stress;  // a chain hardly deforms
  if (scene.is(IntegratorKind::explicit_euler)) {                 // the other's forecast is of the default tolerance
    const ExpectedSteps expected = BreakupRun(scene, start, 1).expected_steps();
    EXPECT_LT(expected.least, broken);
    EXPECT_GT(expected.most, broken);
  }
  ASSERT_GT(steps - broken, 3) << "to cover several pieces";
  const test::Folder folder;
  const std::string output = folder.file("out.h5");
  for (const int stop : {broken / 2 + 1, broken + 1, (broken + steps) / 2}) {
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
    EXPECT_EQ(whole.breakup().severed, second.breakup().severed);
    EXPECT_EQ(whole.breakup().fragments, second.breakup().fragments);
    EXPECT_EQ(whole.events().size(), second.events().size());
  }
}

// Pieces move one after the other through the same interval; what they tell of it stands in order of time.
TEST(Breakup, EventsOfSeveralPiecesAreInOrderOfTime) {
  BreakerScene scene;
  scene.model = elongation(Rung::fts);
  scene.protocol = Protocol({{0, 5e7}});
  scene.largest_stress = 1e7;
  scene.tolerance = 0.1;
  scene.until_stable = true;
  scene.stable_strain = 2;
  scene.lost_particles = 1;
  // A cube of 4 x 4 x 4 spheres with holes: its pieces break on.
  std::vector<Vector3> x;
  for (int k = 0; k < 64; ++k)
    if (k % 5 != 3) x.emplace_back(2.0 * (k / 16), 2.0 * (k / 4 % 4), 2.0 * (k % 4));
  const Agglomerate start = cluster(x);
  BreakupRun run(scene, start, 1);
  while (!run.finished()) run.step();
  ASSERT_GT(run.breakup().fragments.size(), 2u);
  const auto earlier = [](const Event& a, const Event& b) { return a.time < b.time; };
  EXPECT_TRUE(std::is_sorted(run.events().begin(), run.events().end(), earlier));
}

INSTANTIATE_TEST_SUITE_P(Integrators, BreakupRestart, ::testing::Bool(),
                         [](const auto& made_of) { return made_of.param ? "explicit_euler" : "implicit"; });

}  // namespace
}  // namespace crumble::breaker
