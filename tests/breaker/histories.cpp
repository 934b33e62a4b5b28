// Breakup along a history of the velocity gradient.
#include <gtest/gtest.h>

#include <cmath>

#include "breaker/breakup_checkpoint.hpp"
#include "tests/breaker/interrupted.hpp"
#include "tests/breaker/samples.hpp"

namespace crumble::breaker {
namespace {

using namespace testing;

// gradient(t) at t = 0, step, ... to the end.
template <class Gradient>
Protocol along(double end, double step, const Gradient& gradient, double begin = 0) {
  std::vector<double> time;
  std::vector<Eigen::Matrix3d> values;
  for (int k = 0; k <= std::lround(end / step); ++k) {
    time.push_back(begin + k * step);
    values.push_back(gradient(k * step));
  }
  const auto place = [](std::size_t k) { return std::to_string(k); };
  return Protocol(std::make_shared<const GradientHistory>(GradientHistory::of(time, values, "made", 1, place)), 1);
}

BreakerScene scene_with(const Protocol& protocol) {
  BreakerScene scene;
  scene.model = elongation(Rung::fts_relative_lubrication);
  scene.model.weak_stress = 1;
  scene.largest_stress = 1e9;
  scene.protocol = protocol;
  return scene;
}

// Powers of two, so that interpolation and products are exact: 4096 Pa at 1 Pa s.
TEST(History, ThatIsConstantGivesTheBitsOfTheConstantFlow) {
  const Agglomerate start = cluster(bent_chain());
  const Eigen::Matrix3d gradient = 4096 * elongation(Rung::fts).gradient;
  const BreakerScene one = scene_with(along(
      0.25, 1.0 / 16384, [&](double) { return gradient; }, 8));
  const BreakerScene other = scene_with(Protocol({{4096, 0, 0.25}}));
  BreakupRun history(one, start, 1), held(other, start, 1);
  for (int k = 0; k < 40; ++k) {
    history.step();
    held.step();
  }
  const Frame f = history.laboratory(), g = held.laboratory();
  EXPECT_GT(f.time, 1e-4);
  EXPECT_LT(f.time, 0.1);  // before steps are cut to end with it
  EXPECT_EQ(f.time, g.time);
  EXPECT_EQ(f.position, g.position);
  EXPECT_EQ(history.stress(), 4096);
}

// The granule in simple shear, seen from axes that turn at 700 rad/s: gradient Q L Q^T + dQ/dt Q^T. Bond forces cannot
// tell. Rows are 0.007 rad apart: straight lines between them miss the gradient by 6e-6.
TEST(History, SeenFromTurningAxesLoadsContactsAsBefore) {
  const Eigen::Matrix3d shear = 1000 * simple_shear(1).gradient;
  const Vector3 axis = Vector3(0.3, 1, -0.5).normalized();
  const double turning = 700;
  Eigen::Matrix3d spin;
  spin << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  spin *= turning;
  const auto turned = [&](double t) {
    const Eigen::Matrix3d Q = Eigen::AngleAxisd(turning * t, axis).toRotationMatrix();
    return Eigen::Matrix3d(Q * shear * Q.transpose() + spin);
  };
  const Agglomerate start = cluster(bent_chain());
  const double end = 0.01;  // strain 10, and a turn of 7 rad
  const BreakerScene still = scene_with(along(end, 1e-5, [&](double) { return shear; })),
                     moving = scene_with(along(end, 1e-5, turned));
  std::vector<Frame> found;
  for (const BreakerScene* scene : {&still, &moving}) {
    BreakupRun run(*scene, start, 0.1);  // of the tolerance: steps of the two differ
    while (!run.finished()) run.step();
    ASSERT_FALSE(run.breakup().severed);
    found.push_back(run.laboratory());
  }
  EXPECT_EQ(found[0].time, found[1].time);
  ASSERT_EQ(found[0].contacts.size(), found[1].contacts.size());
  const BondLaw law(ContactChoice{}, Material{}, a, a);
  const double range = law.jkr.pull_off_gap - law.jkr.equilibrium_gap;
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(turning * end, axis).toRotationMatrix();
  double loaded = 0;
  for (std::size_t b = 0; b < found[0].contacts.size(); ++b) {
    const Contact &one = found[0].contacts[b], &other = found[1].contacts[b];
    loaded = std::max(loaded, std::abs(one.gap - law.jkr.equilibrium_gap) / range);
    EXPECT_NEAR(one.gap, other.gap, 1e-3 * range);
    EXPECT_LT((Q * one.normal - other.normal).norm(), 1e-3);
  }
  EXPECT_GT(loaded, 0.02);
}

// A burst of a thousandth of the history, in a flow so weak that steps would be as long as they like.
TEST(History, StepsMissNoBurst) {
  const Agglomerate start = cluster(chain(4));
  const auto burst = [](double t) {
    const double strength = std::abs(t - 0.5) < 5e-4 ? 4e4 * (1 - std::abs(t - 0.5) / 5e-4) : 0;
    return Eigen::Matrix3d((0.01 + strength) * planar_elongation(1).gradient);
  };
  const BreakerScene scene = scene_with(along(1, 1e-5, burst));
  BreakupRun run(scene, start, 1);
  while (!run.finished()) run.step();
  ASSERT_TRUE(run.breakup().severed);
  EXPECT_NEAR(run.breakup().severed->time, 0.5, 5e-4);
  EXPECT_EQ(run.breakup().severed->measure, run.breakup().severed->time);
  EXPECT_GT(run.breakup().severed->stress, 1000);
}

TEST(History, CornersAreWhereItIsNotStraight) {
  const auto kink = [](double t) { return Eigen::Matrix3d((t < 0.375 ? t : 0.375) * simple_shear(1).gradient); };
  const Protocol protocol = along(1, 1.0 / 64, kink);
  EXPECT_EQ(protocol.corners(1e-6, 0), (std::vector<double>{0, 0.375, 1}));
  EXPECT_EQ(protocol.end(), 1);
  EXPECT_NEAR(protocol.strain(1), 0.375 * 0.375 / 2 + 0.625 * 0.375, 1e-12);
  EXPECT_EQ(protocol.time_of(0.25), 0.25);
  EXPECT_EQ(protocol.time_of(0.5), std::numeric_limits<double>::infinity());
  // Between corners no row is farther from the chord than allowed.
  const auto wave = [](double t) { return Eigen::Matrix3d((2 + std::sin(40 * t)) * simple_shear(1).gradient); };
  const Protocol waves = along(1, 1e-3, wave);
  const std::vector<double> corners = waves.corners(0.01, 0);
  EXPECT_GT(corners.size(), 30u);
  EXPECT_LT(corners.size(), 300u);
  for (std::size_t c = 1; c < corners.size(); ++c)
    for (double t = corners[c - 1]; t < corners[c]; t += 1e-3) {
      const double part = (t - corners[c - 1]) / (corners[c] - corners[c - 1]);
      const double chord = (1 - part) * waves.stress(corners[c - 1]) + part * waves.stress(corners[c]);
      EXPECT_NEAR(waves.stress(t), chord, 0.01 * 3);
    }
}

class HistoryRestart : public ::testing::TestWithParam<bool> {};

// Before, in and after breakup, the pieces followed to the end of the history.
TEST_P(HistoryRestart, ContinuesToTheSameBits) {
  const Agglomerate start = cluster(chain(8));
  const auto growing = [](double t) { return Eigen::Matrix3d(2e7 * t * planar_elongation(1).gradient); };
  BreakerScene scene = scene_with(along(1e-3, 1e-6, growing));
  scene.model.hydro.rung = Rung::fts;
  scene.tolerance = 0.03;
  scene.until_stable = true;
  if (GetParam()) scene.integrator = IntegratorKind::explicit_euler;
  BreakupRun whole(scene, start, 1);
  const Whole when = to_the_end(whole);
  ASSERT_GT(when.broken, 0);
  EXPECT_EQ(whole.time(), scene.protocol.end());
  EXPECT_EQ(whole.fraction(), 1);
  expect_to_go_on_to_the_same_bits(scene, start, whole, when);
}

INSTANTIATE_TEST_SUITE_P(Integrators, HistoryRestart, ::testing::Bool(),
                         [](const auto& made_of) { return made_of.param ? "explicit_euler" : "implicit"; });

// The reference integrator knows neither corners of its own nor axes that turn.
TEST(History, BreaksAtTheSameTimeWithEitherIntegrator) {
  const Agglomerate start = cluster(bent_chain());
  const auto growing = [](double t) {
    return Eigen::Matrix3d(1e7 * t * (planar_elongation(1).gradient + 0.5 * simple_shear(1).gradient));
  };
  BreakerScene scene = scene_with(along(2e-3, 2e-6, growing));
  BreakupRun fast(scene, start, 1);
  while (!fast.finished()) fast.step();
  scene.integrator = IntegratorKind::explicit_euler;
  BreakupRun slow(scene, start, 1);
  while (!slow.finished()) slow.step();
  ASSERT_TRUE(fast.breakup().severed && slow.breakup().severed);
  EXPECT_NEAR(fast.breakup().severed->time / slow.breakup().severed->time, 1, 0.01);
}

}  // namespace
}  // namespace crumble::breaker
