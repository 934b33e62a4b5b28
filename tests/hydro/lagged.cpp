// Pair sums and lagged factors give what the dense matrix of the same configuration gives.
#include "common/hydro/lagged_hydrodynamics.hpp"

#include <gtest/gtest.h>

#include "clusters.hpp"
#include "common/hydro/dense_hydrodynamics.hpp"
#include "elastic_network.hpp"

namespace crumble::testing {
namespace {

HydroModel relative() {
  HydroModel m;
  m.rung = Rung::fts_relative_lubrication;
  return m;
}

std::vector<Vector3> moved(std::vector<Vector3> x, double distance) {
  double k = 0;
  for (Vector3& p : x) {
    p += distance * Vector3(std::sin(3 * k), std::sin(5 * k + 1), std::sin(7 * k + 2));
    k += 1;
  }
  return x;
}

TEST(FarFieldSum, IsTheProductWithTheMatrix) {
  for (const Spheres& s : {random_spheres(1, 5, 1), random_spheres(37, 12, 2, 1, 4), random_spheres(64, 1e3, 3)}) {
    const Eigen::MatrixXd M = far_field_mobility(s).lower.selfadjointView<Eigen::Lower>();
    const Eigen::VectorXd q = wave(11 * s.size());
    Eigen::VectorXd w(q.size());
    FarFieldSum(s).apply(q.data(), w.data());
    EXPECT_LT((w - M * q).norm(), 1e-14 * (M * q).norm());
  }
}

TEST(LaggedHydrodynamics, AgreesWithTheDenseSolveOfTheSameConfiguration) {
  const DriedCluster c = dried_cluster("compact_85");
  const LinearFlow flow = {Vector3(0.1, 0.2, 0.3), simple_shear(1).gradient};
  const Eigen::VectorXd loads = wave(6 * c.spheres.size());
  for (const bool single : {false, true})
    for (const Rung rung : {Rung::fts, Rung::fts_lubrication, Rung::fts_relative_lubrication}) {
      HydroModel model = relative();
      model.rung = rung;
      LaggedHydrodynamics lagged(c.spheres, 1, model, {1e-10, 30, single});
      for (const double distance : {0.0, 1e-5, 1e-3}) {
        Spheres s = c.spheres;
        s.position = moved(s.position, distance);
        lagged.update(s.position);
        const DenseHydrodynamics dense(s, 1, model);
        const SphereMotion expected = dense.mobility(loads, flow), found = lagged.mobility(loads, flow);
        const double tolerance =
            1e-8;  // of the iteration, times the spread of motions (a pair at the floor moves 1e-6)
        EXPECT_LT((found.velocity - expected.velocity).norm(), tolerance * expected.velocity.norm())
            << distance << " " << single;
        EXPECT_LT((found.stresslet - expected.stresslet).norm(), tolerance * expected.stresslet.norm());
        const SphereLoads there = dense.resistance(expected.velocity, flow),
                          here = lagged.resistance(expected.velocity, flow);
        EXPECT_LT((here.force_torque - there.force_torque).norm(), tolerance * there.force_torque.norm());
      }
      // 1e-5 a is within reach of the first factor; 1e-3 a opens and closes gaps of contacts.
      EXPECT_LE(lagged.work().factorisations, rung == Rung::fts ? 1 : 2);
    }
}

TEST(LaggedHydrodynamics, RenewsItsFactorWhenItIsTooOld) {
  const Spheres s = random_spheres(30, 9, 5);
  LaggedHydrodynamics lagged(s, 1, relative(), {1e-8, 6, false});
  const Eigen::VectorXd loads = wave(180);
  lagged.mobility(loads, {});
  EXPECT_EQ(lagged.work().factorisations, 1);
  Spheres far = s;
  for (auto& x : far.position) x *= 1.5;
  lagged.update(far.position);
  lagged.mobility(loads, {});
  EXPECT_EQ(lagged.work().factorisations, 2);
  lagged.mobility(loads, {});
  EXPECT_EQ(lagged.work().factorisations, 2);
  EXPECT_LE(lagged.work().iterations, 2);
}

}  // namespace
}  // namespace crumble::testing
