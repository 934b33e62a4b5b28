// One bond of two spheres, driven beyond its limits, stopped and reversed: against closed forms, for the implicit step
// and for the explicit one. The drag is c on every (dx, L dtheta); displacements stay far below the radius.
#include <gtest/gtest.h>

#include "breaker/contact_network.hpp"
#include "breaker/implicit_step.hpp"
#include "samples.hpp"

namespace crumble::breaker {
namespace {

using namespace testing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double c = 1e-6;  // N s/m

// One phase: what drives the pair, and for how long.
struct Phase {
  double drive, duration;
};

struct Pair2 {
  Agglomerate g = cluster(chain(2));
  ContactNetwork network{ContactChoice{}, Material{}, g.particles.radius, g.state};
  const BondLaw& law = network.laws()(0, 1);
  MatrixXd R = c * MatrixXd::Identity(12, 12);
  ImplicitStep solver{g.particles.radius, a, network.laws()};
  VectorXd total = VectorXd::Zero(12);

  void move(const VectorXd& q) {
    for (int p = 0; p < 2; ++p) g.state.position[p] += q.segment<3>(6 * p);
    network.advance(q, a, 0);
    total += q;
  }
  void step(const VectorXd& load, double dt, bool is_explicit) {
    if (is_explicit) {
      VectorXd f = load;
      network.add_loads(a, f);
      move(dt / c * f);
    } else {
      VectorXd q = VectorXd::Zero(12);
      ASSERT_TRUE(solver.solve(g.state, {R, 1 / dt, load}, 1e-18, q).converged);
      move(q);
    }
  }
  const Contact& bond() const { return g.state.contacts.front(); }
};

// x' = rate (drive - k e), the elastic part e capped at e_c: what both spring and total motion do in each phase.
struct Expected {
  double elastic = 0, total = 0;
  void follow(double rate, double k, double limit, const Phase& phase) {
    const double goal = phase.drive / k, tau = 1 / (rate * k), e_c = limit / k;
    double left = phase.duration;
    double reach = 0;  // time until the limit, if it is on the way
    const double cap = std::copysign(e_c, goal - elastic);
    const bool yields = std::abs(goal) > e_c && goal * cap > 0;
    reach = yields ? tau * std::log((goal - elastic) / (goal - cap)) : left;
    const double smooth = std::min(left, reach), before = elastic;
    elastic = goal + (elastic - goal) * std::exp(-smooth / tau);
    total += elastic - before;
    left -= smooth;
    if (left > 0) total += rate * (phase.drive - std::copysign(limit, cap)) * left;
  }
};

// The drive twice the limit, none, twice the limit backwards, half the limit.
std::vector<Phase> history(double limit, double tau) {
  return {{2 * limit, 2 * tau}, {0, 0.5 * tau}, {-2 * limit, 3 * tau}, {0.5 * limit, 2 * tau}};
}

class Plastic : public ::testing::TestWithParam<bool> {
 protected:
  // Both integrators are of first order: 400 steps a relaxation time leave about 0.3 % of the limit.
  template <class Load, class Elastic, class Total>
  void expect(double rate, double k, double limit, const Load& load, const Elastic& elastic, const Total& total) {
    Pair2 pair;
    Expected exact;
    const double tau = 1 / (rate * k);
    double slipped = 0;
    for (const Phase& phase : history(limit, tau)) {
      const int steps = static_cast<int>(std::lround(400 * phase.duration / tau));
      for (int s = 0; s < steps; ++s) pair.step(load(phase.drive), phase.duration / steps, GetParam());
      exact.follow(rate, k, limit, phase);
      EXPECT_NEAR(elastic(pair), exact.elastic, 0.01 * limit / k);
      slipped = std::max(slipped, std::abs(exact.total));
      EXPECT_NEAR(total(pair), exact.total, 0.01 * limit / k + 0.005 * std::abs(exact.total));
    }
    EXPECT_GT(slipped, 1.5 * limit / k);  // it has indeed
  }
};

VectorXd torques(const Vector3& on_i, const Vector3& on_j) {
  VectorXd load = VectorXd::Zero(12);
  load.segment<3>(3) = on_i / a;
  load.segment<3>(9) = on_j / a;
  return load;
}

double turn(const Pair2& pair, int axis) { return (pair.total[9 + axis] - pair.total[3 + axis]) / a; }

// Opposite torques about the normal: (W_j - W_i) = 2 (T - M)/(c L^2).
TEST_P(Plastic, TwistingFollowsItsClosedForm) {
  const Pair2 p;
  expect(
      2 / (c * a * a), p.law.k_t, p.law.M_t_crit,
      [](double T) { return torques(-T * Vector3::UnitX(), T * Vector3::UnitX()); },
      [](const Pair2& pair) { return pair.bond().twisting; }, [](const Pair2& pair) { return turn(pair, 0); });
}

TEST_P(Plastic, RollingFollowsItsClosedForm) {
  const Pair2 p;
  expect(
      2 / (c * a * a), p.law.k_r, p.law.M_r_crit,
      [](double T) { return torques(-T * Vector3::UnitZ(), T * Vector3::UnitZ()); },
      [](const Pair2& pair) { return pair.bond().rolling.z(); }, [](const Pair2& pair) { return turn(pair, 2); });
}

// Forces F across the normal with the torques that the reaction at the contact exerts, so that neither sphere turns
// when F is the reaction: xi = dx_y - l (theta_i + theta_j), and with f = F - k xi
//   dx_y' = 2 f/c,  theta' = -l f/(c L^2)  ->  xi' = (2/c)(1 + l^2/L^2) f.
TEST_P(Plastic, SlidingFollowsItsClosedForm) {
  const Pair2 p;
  const double l = a + 0.5 * p.bond().gap;
  const auto load = [&](double F) {
    VectorXd f = torques(-l * F * Vector3::UnitZ(), -l * F * Vector3::UnitZ());
    f[1] = -F;
    f[7] = F;
    return f;
  };
  expect(
      2 / c * (1 + l * l / (a * a)), p.law.k_s, p.law.F_s_crit, load,
      [](const Pair2& pair) { return pair.bond().sliding.dot(Vector3::UnitY()); },
      [&](const Pair2& pair) { return pair.total[7] - pair.total[1] - l * (pair.total[5] + pair.total[11]) / a; });
}

INSTANTIATE_TEST_SUITE_P(BothIntegrators, Plastic, ::testing::Values(false, true),
                         [](const auto& which) { return which.param ? "Explicit" : "Implicit"; });

// Pulled off at the pull-off force, pushed together again: made at touch, not before (hysteresis of JKR).
TEST(Pair, IsLostAtPullOffAndMadeAgainAtTouch) {
  Pair2 pair;
  const double F_po = pair.law.pull_off_force(), dt = 1e-9;
  VectorXd pull = VectorXd::Zero(12);
  pull[0] = -1.05 * F_po;
  pull[6] = 1.05 * F_po;
  double force_before = 0;
  while (!pair.g.state.contacts.empty()) {
    force_before = pair.bond().normal_force;
    pair.step(pull, dt, false);
  }
  EXPECT_GT(force_before, 0.99 * F_po);
  const auto gap = [&] { return (pair.g.state.position[1] - pair.g.state.position[0]).norm() - 2 * a; };
  EXPECT_GT(gap(), pair.law.lost_gap());
  double open = 0;
  while (pair.g.state.contacts.empty()) {
    open = gap();
    pair.step(-0.01 * pull, dt, false);
  }
  EXPECT_GT(open, 0);
  EXPECT_LT(pair.bond().gap, 0);
  EXPECT_NEAR(pair.bond().normal_force, 8.0 / 9 * F_po, 0.05 * F_po);
  const auto events = pair.network.take_events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, EventKind::rupture);
  EXPECT_EQ(events[1].kind, EventKind::made);
}

}  // namespace
}  // namespace crumble::breaker
