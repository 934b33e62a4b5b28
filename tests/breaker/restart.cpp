// A breakup goes on from its checkpoint to the same bits, with one piece and with several, with either integrator.
#include <gtest/gtest.h>

#include <algorithm>

#include "breaker/breakup_checkpoint.hpp"
#include "tests/breaker/interrupted.hpp"
#include "tests/breaker/samples.hpp"

namespace crumble::breaker {
namespace {

using namespace testing;

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
  const Whole when = to_the_end(whole);
  ASSERT_GT(when.broken, 0);
  scene.rigid_strength = whole.breakup().severed.value().stress;  // a chain hardly deforms
  if (scene.is(IntegratorKind::explicit_euler)) {                 // the other's forecast is of the default tolerance
    const ExpectedSteps expected = BreakupRun(scene, start, 1).expected_steps();
    EXPECT_LT(expected.least, when.broken);
    EXPECT_GT(expected.most, when.broken);
  }
  ASSERT_GT(when.steps - when.broken, 3) << "to cover several pieces";
  expect_to_go_on_to_the_same_bits(scene, start, whole, when);
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
