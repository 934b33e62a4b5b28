// Critical stresses of clusters for which they are known, and the explicit reference beside the default.
#include <gtest/gtest.h>

#include <numbers>

#include "breaker/run.hpp"
#include "samples.hpp"

namespace crumble::breaker {
namespace {

using namespace testing;

double implicit_breaks(const std::vector<Vector3>& centres, Rung rung) {
  const Agglomerate g = cluster(centres);
  const BreakupModel model = elongation(rung);
  const Protocol ramp({{0, 5000}});
  Implicit run(model, ramp, g.particles.radius, g.state, 0.01);
  const double stress = critical_stress(run, ramp);
  std::printf("breaks at %.1f Pa\n", stress);
  return stress;
}

// Stress at which a rigid cluster of touching spheres breaks whose largest tension is the given one in 6 pi mu rate
// a^2.
double rigid_prediction(double tension) {
  return Jkr(Material{}, a).pull_off_force / (6 * std::numbers::pi * a * a * tension);
}

// What bonds give way before they part, and the ramp's last step, is within 0.15 % of the stress.
TEST(Numbers, DoubletOfTheFarFieldBreaksAtTheRigidPrediction) {
  EXPECT_NEAR(implicit_breaks(chain(2), Rung::fts) / rigid_prediction(20.0 / 21), 1, 1.5e-3);
}

// Exact two-sphere hydrodynamics (data/rigid_clusters.csv). A gap floor that is not consistent with the positions would
// lose an eighth.
TEST(Numbers, DoubletWithRelativeLubricationBreaksAtThatOfExactHydrodynamics) {
  EXPECT_NEAR(implicit_breaks(chain(2), Rung::fts_relative_lubrication) / rigid_prediction(1.01936), 1, 2.5e-3);
}

// Rigid, by rigidstress.
TEST(Numbers, LinearTrimerOfTheFarFieldBreaksAtTheRigidPrediction) {
  EXPECT_NEAR(implicit_breaks(chain(3), Rung::fts), 8417, 10);
}

TEST(Numbers, StateDependsOnRateAndViscosityThroughTheirProductOnly) {
  const Agglomerate g = cluster(bent_chain());
  BreakupModel model = elongation(Rung::fts);
  const Protocol slow({{0, 5e5}}), fast({{0, 5e8}});
  Implicit thick(model, slow, g.particles.radius, g.state, 0.01);
  const double first = critical_stress(thick, slow);
  model.viscosity = 1e-3;
  Implicit thin(model, fast, g.particles.radius, g.state, 0.01);
  EXPECT_NEAR(critical_stress(thin, fast) / first, 1, 1e-6);  // round-off, magnified near the end of a bond
}

// Both integrators on the same ramp, fast enough for the explicit one to take seconds: critical stress within 0.5 %,
// and at 50 common stresses up to 95 % of it the gap of every contact within 1e-2 of the pull-off gap. `fine` is the
// step of the explicit one in its default, which is half of the stability limit: its own error is of first order.
void expect_agreement(const std::vector<Vector3>& centres, Rung rung, double rate, double fine = 1) {
  const Agglomerate g = cluster(centres);
  const BreakupModel model = elongation(rung);
  const Protocol ramp({{0, rate}});
  Implicit scout(model, ramp, g.particles.radius, g.state, 0.01);
  const double estimate = critical_stress(scout, ramp);
  std::vector<double> stresses;
  for (int k = 1; k <= 50; ++k) stresses.push_back(0.95 * estimate * k / 50);
  Implicit fast(model, ramp, g.particles.radius, g.state, 1e-3);
  ExplicitEuler reference(model, ramp, g.particles.radius, g.state, 0, false, fine);
  const Outcome one = follow(fast, ramp, stresses, rate), two = follow(reference, ramp, stresses, rate);
  const double h_po = Jkr(Material{}, a).pull_off_gap;
  double worst = 0;
  for (std::size_t k = 0; k < stresses.size(); ++k)
    for (std::size_t b = 0; b < one.gap[k].size(); ++b)
      if (std::min(one.gap[k][b], two.gap[k][b]) <= h_po)
        worst = std::max(worst, std::abs(one.gap[k][b] - two.gap[k][b]));
  EXPECT_NEAR(one.critical / two.critical, 1, 5e-3);
  EXPECT_NEAR(estimate / one.critical, 1, 5e-3);  // the default tolerance, ten times wider
  EXPECT_LT(worst, 1e-2 * h_po);
  std::printf("breaks at %.2f Pa, explicit %.2f Pa; worst gap differs by %.2g h_po; %lld steps for %lld\n",
              one.critical, two.critical, worst / h_po, static_cast<long long>(one.steps),
              static_cast<long long>(two.steps));
}

TEST(Reference, DoubletAgrees) { expect_agreement(chain(2), Rung::fts, 5e6); }
TEST(Reference, TrimerAgrees) { expect_agreement(chain(3), Rung::fts, 5e6); }
TEST(Reference, DoubletWithLubricationAgrees) { expect_agreement(chain(2), Rung::fts_relative_lubrication, 5e6); }
TEST(Reference, TetrahedronAgrees) { expect_agreement(tetrahedron(), Rung::fts, 5e6); }
// Contacts that bend, twist and yield.
TEST(Reference, BentChainAgrees) { expect_agreement(bent_chain(), Rung::fts_relative_lubrication, 2e7, 0.1); }
TEST(Reference, RingAgrees) { expect_agreement(ring(), Rung::fts, 2e7); }

// A run may be stopped between its end and that of its error estimate.
TEST(BreakupRun, ThatHasEndedHasEndedAfterARestart) {
  const Agglomerate doublet = cluster(chain(2));
  for (const double largest : {1e5, 500.}) {
    BreakerScene scene;
    scene.model = elongation(Rung::fts);
    scene.protocol = Protocol({{0, 5e6}});
    scene.largest_stress = 1e5;
    scene.largest_stress = largest;
    BreakupRun run(scene, doublet, 1);
    while (!run.finished()) run.step();
    EXPECT_EQ(run.breakup().severed.has_value(), largest > 2e4);
    EXPECT_EQ(run.ending().empty(), largest > 2e4);
    BreakupRun again(scene, doublet, 1);
    load(again, save(run));
    EXPECT_TRUE(again.finished());
    EXPECT_EQ(again.ending(), run.ending());
    EXPECT_EQ(again.breakup().severed, run.breakup().severed);
  }
}

}  // namespace
}  // namespace crumble::breaker
