// Forces between near surfaces of a granule in its liquid.
#include <gtest/gtest.h>

#include <cmath>

#include "breaker/surface_pairs.hpp"
#include "samples.hpp"

namespace crumble::breaker {
namespace {

using namespace testing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SurfaceForces forces(double hamaker, double potential, double ionic_strength) {
  SurfaceForces f;
  f.hamaker = hamaker;
  f.surface_potential = potential;
  f.electrolyte = {ionic_strength, 78.4 * vacuum_permittivity, 1.380649e-23 * 300};
  f.solubility = 5400;
  return f;
}

// A bonded pair and open ones at 0.1, 0.5 and 3 nm, increments of a tenth of a nanometre.
struct Scattered {
  std::vector<double> radius{a, a, a, 0.8 * a, a};
  Frame frame;
  BondLaws bonds{{}, {}, radius};
  SurfacePairs pairs{forces(9.85e-21, 0.04, 10), bonds, radius};
  VectorXd q = VectorXd::Zero(30);

  Scattered() {
    const double gap[] = {-0.3e-9, 0.1e-9, 0.5e-9, 3e-9};
    frame.position.push_back(Vector3::Zero());
    for (int k = 0; k < 4; ++k) {
      const Vector3 way = Vector3(1, 0.3 * k, -0.2 * k * k).normalized();
      frame.position.push_back(frame.position.back() + (radius[k] + radius[k + 1] + gap[k]) * way);
    }
    frame.contacts.push_back(
        make_bond(bonds(0, 1), 0, 1, frame.position[1] - frame.position[0], radius[0], radius[1], 0));
    for (Eigen::Index k = 0; k < 30; ++k) q[k] = 2e-11 * std::sin(3.0 + 7 * static_cast<double>(k));
    pairs.update(frame);
  }
};

TEST(SurfacePairs, GradientAndStiffnessAreDerivativesOfTheEnergy) {
  const Scattered s;
  ASSERT_EQ(s.pairs.size(), 4u);
  VectorXd g = VectorXd::Zero(30);
  s.pairs.add_gradient(s.frame, s.q, g);
  MatrixXd K = MatrixXd::Zero(30, 30);
  s.pairs.add_stiffness(s.frame, s.q, Curvature::full, K);
  K = MatrixXd(K.selfadjointView<Eigen::Lower>());
  const double step = 1e-14;
  for (Eigen::Index k = 0; k < 30; ++k) {
    VectorXd up = s.q, down = s.q;
    up[k] += step;
    down[k] -= step;
    EXPECT_NEAR((s.pairs.energy(s.frame, up) - s.pairs.energy(s.frame, down)) / (2 * step), g[k], 2e-4 * g.norm()) << k;
    VectorXd g_up = VectorXd::Zero(30), g_down = g_up;
    s.pairs.add_gradient(s.frame, up, g_up);
    s.pairs.add_gradient(s.frame, down, g_down);
    EXPECT_LT(((g_up - g_down) / (2 * step) - K.col(k)).norm(), 1e-3 * K.norm()) << k;
  }
  // Loads are minus the gradient at rest, and add up to nothing.
  VectorXd loads = VectorXd::Zero(30), at_rest = loads;
  s.pairs.add_loads(s.frame, loads);
  s.pairs.add_gradient(s.frame, VectorXd::Zero(30), at_rest);
  EXPECT_LT((loads + at_rest).norm(), 1e-12 * loads.norm());
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index p = 0; p < 5; ++p) sum += loads.segment<3>(6 * p);
  EXPECT_LT(sum.norm(), 1e-12 * loads.norm());
}

TEST(SurfacePairs, ConvexPartIsPositiveSemidefinite) {
  const Scattered s;
  MatrixXd K = MatrixXd::Zero(30, 30);
  s.pairs.add_stiffness(s.frame, s.q, Curvature::convex, K);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(K);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-9 * eigen.eigenvalues().maxCoeff());
  EXPECT_GT(eigen.eigenvalues().maxCoeff(), 0);
}

// The bond of a doublet lets go at h_po when the flow pulls with F_po less what the double layers push there.
TEST(SurfaceForces, LowerTheCriticalStressOfADoubletByTheRepulsionAtPullOff) {
  const Agglomerate g = cluster(chain(2));
  BreakupModel model = elongation(Rung::fts);
  const Protocol ramp({{0, 5000}});
  const auto implicit = [&] {
    Implicit run(model, ramp, g.particles.radius, g.state, 0.01);
    return critical_stress(run, ramp);
  };
  const double alone = implicit();
  model.surface_forces = forces(9.85e-21, 0.03, 100);
  const BondLaws bonds(model.contact, model.material, g.particles.radius);
  const SurfaceForceLaws laws(*model.surface_forces, bonds, g.particles.radius);
  const double F_po = bonds(0, 1).pull_off_force(), push = -laws(0, 1).repulsion.tension(bonds(0, 1).lost_gap());
  ASSERT_GT(push, 0.05 * F_po);
  EXPECT_NEAR(implicit() / alone, (F_po - push) / F_po, 2e-3);
}

TEST(SurfaceForces, BothIntegratorsBreakAChargedTrimerAtTheSameStress) {
  const Agglomerate g = cluster(chain(3));
  BreakupModel model = elongation(Rung::fts);
  model.surface_forces = forces(9.85e-21, 0.03, 100);
  const Protocol ramp({{0, 2e8}});
  Implicit fast(model, ramp, g.particles.radius, g.state, 0.01);
  ExplicitEuler slow(model, ramp, g.particles.radius, g.state, 0);
  EXPECT_NEAR(critical_stress(fast, ramp) / critical_stress(slow, ramp), 1, 5e-3);
}

// Two spheres that are let go 2 nm apart in a liquid at rest: when they touch. The explicit integrator is within 0.3 %
// of itself with four times the step; the implicit one converges to it with its tolerance.
TEST(SurfaceForces, PairAtRestClosesInTheSameTimeByBothIntegrators) {
  const Agglomerate g = cluster({Vector3(0, 0, 0), Vector3(2.02, 0, 0)});
  ASSERT_TRUE(g.state.contacts.empty());
  BreakupModel model = elongation(Rung::fts);
  model.surface_forces = forces(9.85e-21, 0, 100);
  const Protocol rest({{0, 0}});
  const auto time_to_touch = [](Integrator& run) {
    while (run.frame().contacts.empty()) run.step(1);
    return run.frame().time;
  };
  ExplicitEuler slow(model, rest, g.particles.radius, g.state, 0);
  const double exact = time_to_touch(slow);
  for (const double tolerance : {0.01, 0.0025}) {
    Implicit fast(model, rest, g.particles.radius, g.state, tolerance);
    const double off = time_to_touch(fast) / exact - 1;
    std::printf("tolerance %g: %+.2g %%, %lld steps\n", tolerance, 100 * off,
                static_cast<long long>(fast.statistics().steps));
    EXPECT_NEAR(off, 0, 4 * tolerance) << tolerance;
  }
}

}  // namespace
}  // namespace crumble::breaker
