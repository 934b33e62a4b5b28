// Laws and closed forms behind the integrators.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "breaker/alignment.hpp"
#include "common/hydro/dense_hydrodynamics.hpp"
#include "common/hydro/rigid_body.hpp"
#include "samples.hpp"

namespace crumble::breaker {
namespace {

using namespace testing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const BondLaw law(ContactChoice{}, Material{}, a, a);

// A stretched bond with loaded springs, increments that move it by some of its range.
struct Bent {
  Contact bond;
  Vector3 separation;
  Vector6 q_i, q_j;
  BondEnds ends{a, a, a, a};
};

Bent bent(double gap, double spring, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&] { return Vector3(any(random), any(random), any(random)); };
  Bent b;
  b.bond.i = 0;
  b.bond.j = 1;
  b.bond.normal = vector().normalized();
  b.separation = (2 * a + gap) * b.bond.normal;
  b.bond.gap = gap;
  const auto across = [&](const Vector3& v) { return Vector3(v - b.bond.normal.dot(v) * b.bond.normal); };
  b.bond.sliding = across(spring * law.F_s_crit / law.k_s * vector());
  b.bond.rolling = across(spring * law.M_r_crit / law.k_r * vector());
  b.bond.twisting = spring * law.M_t_crit / law.k_t * any(random);
  const double size = 1e-10;
  b.q_i << size * vector(), size * vector();
  b.q_j << size * vector(), size * vector();
  return b;
}

double energy(const Bent& b, const Vector6& q_i, const Vector6& q_j) {
  return BondIncrement(b.bond, law, b.ends, b.separation, q_i, q_j).energy();
}

VectorXd gradient(const Bent& b, const Vector6& q_i, const Vector6& q_j) {
  Vector6 g_i = Vector6::Zero(), g_j = Vector6::Zero();
  BondIncrement(b.bond, law, b.ends, b.separation, q_i, q_j).add_gradient(g_i, g_j);
  VectorXd g(12);
  g << g_i, g_j;
  return g;
}

// Elastic (spring 0.5), yielding (spring 2) and compressed; differences over 1e-14 m.
TEST(BondIncrement, GradientAndStiffnessAreDerivativesOfTheEnergy) {
  for (const double gap : {-0.4e-9, -0.1e-9, 0.02e-9})
    for (const double spring : {0.5, 2.0})
      for (std::uint32_t seed = 1; seed < 6; ++seed) {
        const Bent b = bent(gap, spring, seed);
        const VectorXd g = gradient(b, b.q_i, b.q_j);
        Matrix6 K_ii, K_ij, K_jj;
        BondIncrement(b.bond, law, b.ends, b.separation, b.q_i, b.q_j).stiffness(K_ii, K_ij, K_jj, Curvature::full);
        MatrixXd K(12, 12);
        K << K_ii, K_ij, K_ij.transpose(), K_jj;
        const double step = 1e-14;
        for (int k = 0; k < 12; ++k) {
          Vector6 up_i = b.q_i, up_j = b.q_j, down_i = b.q_i, down_j = b.q_j;
          (k < 6 ? up_i[k] : up_j[k - 6]) += step;
          (k < 6 ? down_i[k] : down_j[k - 6]) -= step;
          const double slope = (energy(b, up_i, up_j) - energy(b, down_i, down_j)) / (2 * step);
          // The energy is known to 1e-16 of 1e-18 J, the slope to 1e-20 N/m-ish of 1e-9 N.
          EXPECT_NEAR(slope, g[k], 2e-4 * g.norm());
          const VectorXd column = (gradient(b, up_i, up_j) - gradient(b, down_i, down_j)) / (2 * step);
          EXPECT_LT((column - K.col(k)).norm(), 1e-4 * K.norm());
        }
      }
}

// A pair that turns by 0.04 rad while its springs are strained a little: loads at the end of the step, from the bond
// foreseen there, are those that advance() then gives. Those of the frame at the start are off by the angle.
TEST(BondIncrement, OfTheForeseenBondHasTheLoadsOfTheEndOfTheStep) {
  for (std::uint32_t seed = 1; seed < 6; ++seed) {
    Bent b = bent(-0.15e-9, 0.5, seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    const Vector3 turn = 0.04 * Vector3(any(random), any(random), any(random)).normalized();
    const Eigen::AngleAxisd rotation(turn.norm(), turn.normalized());
    b.q_i = 0.1 * b.q_i;
    b.q_j = 0.1 * b.q_j;
    b.q_j.head<3>() += rotation * b.separation - b.separation;
    b.q_i.tail<3>() += a * turn;
    b.q_j.tail<3>() += a * turn;
    Contact moved = b.bond;
    const Vector3 dx = b.q_j.head<3>() - b.q_i.head<3>();
    advance(moved, law, {b.separation + dx, dx, b.q_i.tail<3>() / a, b.q_j.tail<3>() / a, a, a});
    ASSERT_EQ(moved.at_limit, 0);
    VectorXd loads(12);
    const double l = lever_arm(moved, a, a);
    loads << -force_on_j(moved), torque_on_i(moved, l) / a, force_on_j(moved), torque_on_j(moved, l) / a;
    Bent from_end = b;
    from_end.bond = foreseen(b.bond, law, b.ends, b.separation, b.q_i, b.q_j);
    EXPECT_LT((gradient(from_end, b.q_i, b.q_j) + loads).norm(), 1e-9 * loads.norm());
    EXPECT_GT((gradient(b, b.q_i, b.q_j) + loads).norm(), 1e-4 * loads.norm());
  }
}

TEST(BondIncrement, ConvexPartIsPositiveSemidefiniteUnderCompression) {
  const Bent b = bent(-0.5e-9, 2, 3);
  Matrix6 K_ii, K_ij, K_jj;
  BondIncrement(b.bond, law, b.ends, b.separation, b.q_i, b.q_j).stiffness(K_ii, K_ij, K_jj, Curvature::convex);
  MatrixXd K(12, 12);
  K << K_ii, K_ij, K_ij.transpose(), K_jj;
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(K).eigenvalues().minCoeff(), -1e-12 * K.norm());
}

// Loads of motions and strains from a dense factor of the whole mobility, which shares no code with the frame.
void expect_same_loads(Rung rung) {
  const Agglomerate g = cluster(bent_chain());
  HydroModel model{rung};
  model.gap_floor = 1e-3;
  const double mu = 0.7;
  BodyHydrodynamics body(g.particles.radius, mu, model);
  body.renew_far_field(g.state.position);
  const DenseHydrodynamics dense({g.state.position, g.particles.radius}, mu, model);
  Vector3 centre = Vector3::Zero();
  for (const Vector3& x : g.state.position) centre += x / 5;
  const RigidBodyResponse rigid = rigid_body_response(dense, g.state.position, centre);
  MatrixXd loads = rigid.free_loads;
  for (int i = 3; i < 30; i += 6) loads.middleRows(i, 3) /= a;
  EXPECT_LT((loads - body.free_loads()).norm(), 1e-10 * loads.norm());
  EXPECT_LT((rigid.drift.bottomRows<3>() - body.turning()).norm(), 1e-10);

  const VectorXd y = VectorXd::LinSpaced(30, -1, 2) * 1e-6;
  VectorXd motion = y;
  for (int i = 3; i < 30; i += 6) motion.segment<3>(i) /= a;
  VectorXd exact = dense.relative_resistance(motion, MatrixXd::Zero(5, 1)).force_torque;
  for (int i = 3; i < 30; i += 6) exact.segment<3>(i) /= a;
  EXPECT_LT((exact + body.resistance() * y).norm(), 1e-10 * exact.norm());
}

TEST(BodyHydrodynamics, IsThatOfTheDenseFactor) {
  expect_same_loads(Rung::fts);
  expect_same_loads(Rung::fts_relative_lubrication);
  expect_same_loads(Rung::fts_lubrication);
}

// 115 spheres at least 2.02 a apart on a sphere of 6.6 a, and a string of 30.
TEST(BodyHydrodynamics, SinglePrecisionIsAsGoodAsItSays) {
  std::vector<Vector3> shell, string;
  for (int k = 0; k < 115; ++k) {
    const double z = 1 - (2 * k + 1) / 115.0, turn = k * std::numbers::pi * (3 - std::sqrt(5.0)),
                 s = std::sqrt(1 - z * z);
    shell.push_back(6.6 * a * Vector3(s * std::cos(turn), s * std::sin(turn), z));
  }
  for (int k = 0; k < 30; ++k) string.push_back({2 * a * k, 0, 0});
  for (const auto& position : {shell, string})
    for (const Rung rung : {Rung::fts, Rung::fts_relative_lubrication}) {
      using Precision = BodyHydrodynamics::Precision;
      const std::vector<double> radius(position.size(), a);
      const HydroModel model = elongation(rung).hydro;
      BodyHydrodynamics coarse(radius, 1, model, Precision::float32), fine(radius, 1, model, Precision::float64);
      coarse.renew_far_field(position);
      fine.renew_far_field(position);
      const double error = BodyHydrodynamics::single_error;
      EXPECT_LT((coarse.resistance() - fine.resistance()).norm(), error * fine.resistance().norm());
      EXPECT_LT((coarse.free_loads() - fine.free_loads()).norm(), error * fine.free_loads().norm());
      EXPECT_LT((coarse.turning() - fine.turning()).norm(), error);
      EXPECT_GT((coarse.resistance() - fine.resistance()).norm(), 0);
    }
}

TEST(BodyHydrodynamics, FreeLoadsHaveNoNetForceNorTorque) {
  const Agglomerate g = cluster(bent_chain());
  BodyHydrodynamics body(g.particles.radius, 1, elongation(Rung::fts_lubrication).hydro);
  body.renew_far_field(g.state.position);
  for (int k = 0; k < 5; ++k) {
    Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
    for (int i = 0; i < 5; ++i) {
      const Vector3 F = body.free_loads().col(k).segment<3>(6 * i);
      force += F;
      torque += g.state.position[i].cross(F) + a * body.free_loads().col(k).segment<3>(6 * i + 3);
    }
    EXPECT_LT(force.norm(), 1e-12 * body.free_loads().norm());
    EXPECT_LT(torque.norm(), 1e-12 * a * body.free_loads().norm());
  }
}

// The state of a cluster that is turned together with its flow is the same but for the turn.
TEST(Implicit, DoesNotKnowTheAxesOfTheLaboratory) {
  const Quaternion turn(Eigen::AngleAxisd(1.1, Vector3(1, -2, 0.5).normalized()));
  Agglomerate g = cluster(bent_chain());
  BreakupModel model = elongation(Rung::fts_relative_lubrication);
  const Protocol ramp({{0, 5e5}});
  Implicit straight(model, ramp, g.particles.radius, g.state, 0.01);
  const Outcome one = follow(straight, ramp, {500, 2000}, 5e5);
  for (Vector3& x : g.state.position) x = turn * x;
  for (Contact& c : g.state.contacts) c.normal = turn * c.normal;
  const Eigen::Matrix3d Q = turn.toRotationMatrix();
  model.gradient = Q * model.gradient * Q.transpose();
  Implicit turned(model, ramp, g.particles.radius, g.state, 0.01);
  const Outcome two = follow(turned, ramp, {500, 2000}, 5e5);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t b = 0; b < 4; ++b) EXPECT_NEAR(one.gap[k][b], two.gap[k][b], 1e-16);  // 1e-6 of the range
  EXPECT_NEAR(one.critical / two.critical, 1, 1e-6);
}

// The formula is of second order; yielding contacts and matrices kept for a while leave a first-order part, so errors
// fall at least like 1/steps.
TEST(Implicit, ErrorsFallAtLeastLikeOneOverSteps) {
  const Agglomerate g = cluster(bent_chain());
  const BreakupModel model = elongation(Rung::fts);
  const double rate = 2e6;
  const Protocol ramp({{0, rate}});
  const auto result = [&](double tolerance) {
    Implicit run(model, ramp, g.particles.radius, g.state, tolerance);
    std::vector<double> h;
    for (const double stress : {1000., 2000., 3000.}) {
      while (run.frame().time < stress / rate) run.step(stress / rate);
      for (const double gap : gaps(run.frame(), g.state.contacts)) h.push_back(gap);
    }
    return std::pair(h, static_cast<double>(run.statistics().steps));
  };
  const auto exact = result(1e-4).first;
  const auto error = [&](const std::vector<double>& h) {
    double worst = 0;
    for (std::size_t k = 0; k < h.size(); ++k) worst = std::max(worst, std::abs(h[k] - exact[k]));
    return worst;
  };
  // Finer ones stay at the error of 0.01, 1e-4 of the range of a bond.
  const auto [coarse, few] = result(0.1);
  const auto [fine, many] = result(0.01);
  std::printf("error %.2g m in %.0f steps, %.2g m in %.0f\n", error(coarse), few, error(fine), many);
  EXPECT_GT(std::log(error(coarse) / error(fine)) / std::log(many / few), 0.95);
  EXPECT_LT(error(coarse), 0.05 * Jkr(Material{}, a).pull_off_gap);
  EXPECT_LT(error(fine), 1e-3 * Jkr(Material{}, a).pull_off_gap);
}

// Jeffery: an axis in planar elongation turns towards x with dtheta/dstrain = -(B/2) sin 2 theta; tan theta falls like
// exp(-B strain). A doublet has B = (1.98165^2 - 1)/(1.98165^2 + 1) = 0.5941.
TEST(Alignment, OfADoubletTakesTheTimeThatJefferysOrbitTakes) {
  std::vector<Vector3> x = chain(2);
  const double theta = 1.2;
  for (Vector3& v : x) v = Eigen::AngleAxisd(-theta, Vector3::UnitY()) * v;
  const Agglomerate g = cluster(x);
  const BreakupModel model = elongation(Rung::fts_lubrication);
  BodyHydrodynamics body(g.particles.radius, 1, model.hydro);
  body.renew_far_field(g.state.position);
  const double B = 0.5941, strain = std::log(std::tan(theta) / std::tan(0.02)) / B;
  const auto found = alignment_strain(body.turning(), model.gradient);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, strain, 0.5 + 0.02 * strain);  // sampled at strains of 0.5; spheres that overlap a little
}

TEST(Protocol, StagesFollowEachOther) {
  const Protocol p = Protocol({{0, 0, 0.2}, {2, 0, 0.2}, {100, 2500, 0.04}, {200, 0, 2}});
  EXPECT_EQ(p.stages().size(), 4u);
  EXPECT_DOUBLE_EQ(p.stress(0.1), 0);
  EXPECT_DOUBLE_EQ(p.stress(0.2), 2);
  EXPECT_DOUBLE_EQ(p.stress_before(0.2), 0);
  EXPECT_DOUBLE_EQ(p.stress(0.4), 100);
  EXPECT_NEAR(p.stress(0.42), 150, 1e-9);
  EXPECT_DOUBLE_EQ(p.stage_end(0), 0.2);
  EXPECT_NEAR(p.end(), 0.2 + 0.2 + 0.04 + 2, 1e-12);
  EXPECT_NEAR(p.strain(0.44), 2 * 0.2 + 150 * 0.04, 1e-9);
}

TEST(Protocol, TellsWhenARampFirstReachesAStress) {
  const Protocol protocol({{0, 2, 10}, {5, 0, 1}, {5, 10}});
  EXPECT_DOUBLE_EQ(protocol.time_of(20), 10);
  EXPECT_DOUBLE_EQ(protocol.time_of(25), 13);
  EXPECT_TRUE(std::isinf(Protocol({{0, 2, 10}}).time_of(21)));
}

TEST(Protocol, ThePapersGivesTheStrainOfTheRamp) {
  const Protocol p({{0, 0, 0.1}, {2, 0, 0.1}, {0, 5000}});
  // S^2/(2 r mu) at S = 1000 Pa, and 0.2 before.
  EXPECT_NEAR(p.strain(0.4), 100.2, 1e-9);
}

}  // namespace
}  // namespace crumble::breaker
