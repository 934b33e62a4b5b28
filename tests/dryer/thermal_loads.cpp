#include "dryer/thermal_loads.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/agglomerate/bond.hpp"
#include "dryer/drag.hpp"
#include "dryer/stabilised.hpp"
#include "tests/dryer/samples.hpp"
#include "tests/seeds.hpp"

using namespace crumble;
using namespace crumble::dryer;
using namespace crumble::dryer::samples;

// Statistical tests compare a mean with its expectation within 5 of its standard errors: 6e-7 by chance.
namespace {

constexpr double a = 100e-9, kT = boltzmann_constant * 300;

// No surface anywhere near.
DryingModel in_bulk() {
  DryingModel model = hollow();
  model.thermal_energy = kT;
  model.droplet = {0.1, 1e6, 0};
  return model;
}

double D() { return kT / drag_coefficient(1e-3, a); }

// Far from each other, along x.
Agglomerate lonely_pairs(const DryingModel& model, int pairs) {
  const BondLaw law(model.contact, model.material, a, a);
  std::vector<Vector3> position;
  for (int p = 0; p < pairs; ++p) {
    position.emplace_back(20 * a * p, 0, 0);
    position.emplace_back(20 * a * p + 2 * a + law.equilibrium_gap(), 0, 0);
  }
  Agglomerate s = spheres(position, a);
  for (std::int32_t p = 0; p < pairs; ++p)
    s.state.contacts.push_back(make_bond(law, 2 * p, 2 * p + 1, position[2 * p + 1] - position[2 * p], a, a, 0));
  return s;
}

double fastest_interval(double displacement) { return ThermalLoads::interval(in_bulk(), a, displacement); }

TEST(ThermalLoads, a_free_particle_diffuses_6_D_t_at_every_length_of_the_step) {
  const int number = 300;
  for (const double displacement : {0.003, 0.05, 0.2}) {
    std::vector<Vector3> origin;
    for (int p = 0; p < number; ++p) origin.emplace_back(50 * a * p, 0, 0);
    Agglomerate s = spheres(origin, a);
    const DryingModel model = in_bulk();
    Stabilised integrator(model, s, {0.02, displacement}, seeded(1));
    while (s.state.time < 99.5 * fastest_interval(displacement)) integrator.step(100 * fastest_interval(displacement));
    double sum = 0;
    for (int p = 0; p < number; ++p) sum += (s.state.position[p] - origin[p]).squaredNorm();
    // A sum of 3 squared normals a particle: relative standard error sqrt(2/(3 N)).
    expect_near(fmt::format("over 6 D t, {} a", displacement), sum / number / (6 * D() * s.state.time), 1,
                5 * std::sqrt(2.0 / (3 * number)));
  }
}

// Those near another go through all stages, the others the whole way at once.
TEST(ThermalLoads, a_free_particle_goes_the_same_way_with_a_neighbour_as_without) {
  const auto way = [](const std::vector<Vector3>& position) {
    Agglomerate s = spheres(position, a);
    const DryingModel model = in_bulk();
    Stabilised integrator(model, s, {0.02, 0.05}, seeded(2));
    integrator.step(fastest_interval(0.05));
    EXPECT_EQ(s.state.contacts.size(), 0u);
    return Vector3(s.state.position[0] - position[0]);
  };
  const Vector3 alone = way({Vector3::Zero(), Vector3(5 * a, 0, 0)}),
                beside = way({Vector3::Zero(), Vector3(2.4 * a, 0, 0)});
  EXPECT_GT(alone.norm(), 0.01 * a);
  EXPECT_LT((alone - beside).norm(), 1e-5 * alone.norm());
}

// A doublet is a rigid body to thermal motion: its centre diffuses with D/2, its axis with kT/(2 zeta l^2 + 2 zeta_r),
// l from its centre to that of a sphere.
TEST(ThermalLoads, a_doublet_diffuses_and_tumbles_as_a_rigid_body_and_its_bond_holds_at_every_length_of_the_step) {
  const int pairs = 150, steps = 20;
  for (const double displacement : {0.01, 0.03, 0.1}) {
    DryingModel model = in_bulk();
    model.contact.rolling_limit_factor = 1e9;
    Agglomerate s = lonely_pairs(model, pairs);
    const auto origin = s.state.position;
    Stabilised integrator(model, s, {0.02, displacement}, seeded(3));
    while (integrator.statistics().contacts_lost == 0 && s.state.time < (steps - 0.5) * fastest_interval(displacement))
      integrator.step(1e9);
    EXPECT_EQ(integrator.statistics().contacts_lost, 0) << displacement;
    double centre = 0, axis = 0;
    for (int p = 0; p < pairs; ++p) {
      const Vector3 before = origin[2 * p + 1] - origin[2 * p],
                    now = s.state.position[2 * p + 1] - s.state.position[2 * p];
      centre +=
          0.25 *
          (s.state.position[2 * p] + s.state.position[2 * p + 1] - origin[2 * p] - origin[2 * p + 1]).squaredNorm();
      axis += 1 - std::pow(before.normalized().dot(now.normalized()), 2);
    }
    const double l = 0.5 * (origin[1] - origin[0]).norm(), t = s.state.time;
    const double turning = 2 * drag_coefficient(1e-3, a) * l * l + 2 * rotational_drag_coefficient(1e-3, a);
    expect_near(fmt::format("centre over 3 D t, {} a", displacement), centre / pairs / (3 * D() * t), 1,
                5 * std::sqrt(2.0 / (3 * pairs)));
    // <cos^2> = 1/3 + 2/3 exp(-6 D_r t): diffusion of an axis on the sphere. The variance of sin^2 is at most that of
    // an exponential; rotations of 0.1 in a step are not small to 1 %.
    const double expected = 2.0 / 3 * -std::expm1(-6 * kT / turning * t);
    expect_near(fmt::format("axis, {} a", displacement), axis / pairs / expected, 1, 5 / std::sqrt(pairs) + 0.01);
  }
}

// Bonded pairs in which only twisting is resisted, and elastically: an Ornstein-Uhlenbeck process of the rate
// m = 2 k_t/zeta_r. Its variance is kT/k_t tanh(x)/x, x = m T/2, while a step resolves it (first order), and it falls
// as 1/x beyond: never above kT/k_t.
TEST(ThermalLoads, a_spring_has_its_share_of_kT_where_steps_resolve_it_and_never_more) {
  DryingModel model = in_bulk();
  model.contact.sliding_limit_factor = model.contact.rolling_limit_factor = 0;
  model.contact.twisting_limit_factor = 1e9;
  const BondLaw law(model.contact, model.material, a, a);
  const double relaxation = rotational_drag_coefficient(1e-3, a) / (2 * law.k_t);
  const int pairs = 600;
  for (const double length : {0.1, 1.0, 10.0, 100.0}) {
    const double displacement = std::sqrt(6 * D() * length * relaxation) / a;
    Agglomerate s = lonely_pairs(model, pairs);
    Stabilised integrator(model, s, {0.02, displacement}, seeded(4));
    const double T = fastest_interval(displacement), until = std::max(8 * relaxation, 3.5 * T);
    while (s.state.time < until - 0.5 * T) integrator.step(1e9);
    ASSERT_EQ(s.state.contacts.size(), static_cast<std::size_t>(pairs));
    double sum = 0;
    for (const Contact& bond : s.state.contacts) sum += bond.twisting * bond.twisting;
    const double share = sum / pairs / (kT / law.k_t), x = length / 2, room = 5 * std::sqrt(2.0 / pairs);
    const std::string what = fmt::format("share of kT, {} relaxation times", length);
    // The factor of growth R lies within 0.3 of 0 where the step is long: (1 - R)/(1 + R) between 0.54 and 1.86.
    if (length < 2)
      expect_near(what, share, std::tanh(x) / x, room + 0.15 * x);
    else
      expect_within(what, share, 0.54 / x * (1 - room), 1.86 / x * (1 + room));
  }
}

// The normal distance of bonded pairs, however long the step.
TEST(ThermalLoads, no_bond_stretches_by_more_than_its_share_of_kT) {
  const DryingModel model = in_bulk();
  const BondLaw law(model.contact, model.material, a, a);
  const int pairs = 100;
  for (const double displacement : {3e-4, 2e-3, 0.02, 0.1}) {
    Agglomerate s = lonely_pairs(model, pairs);
    Stabilised integrator(model, s, {0.02, displacement}, seeded(5));
    double square = 0;
    int count = 0;
    for (int k = 0; k < 5; ++k) {
      integrator.step(1e9);
      for (const Contact& bond : s.state.contacts) square += std::pow(bond.gap - law.equilibrium_gap(), 2), ++count;
    }
    EXPECT_EQ(integrator.statistics().contacts_lost, 0) << displacement;
    // Single precision of the loads and the turning of the pair within a step stretch the bond, too.
    const double share = square / count / (kT / law.normal_stiffness());
    expect_within(fmt::format("share of kT, {} a", displacement), share, 0, 1 + 5 * std::sqrt(2.0 / pairs));
  }
}

// A wet particle hangs on one that is dry and as good as fixed; the surface pulls it inwards. The bond is stretched as
// under the load, or as far as it bears: the front moves slowly, and no load comes at once. The largest random force is
// 1.3 % of the pull-off force (standard deviation, 0.005 a).
TEST(ThermalLoads, a_bond_breaks_under_a_load_above_the_pull_off_force_and_holds_below) {
  DryingModel model = in_bulk();
  model.dry.drag_factor = 1e6;
  const BondLaw law(model.contact, model.material, a, a);
  const double R = 10 * a, offset = -0.3 * a;
  for (const double load : {0.5, 0.9, 1.1, 2.0, 20.0}) {
    for (const double displacement : {0.005, 0.05, 0.2}) {
      model.droplet = {R, 1, load * law.pull_off_force() / capillary_force(1, a, offset)};
      const double gap = Jkr(model.material, a).gap(std::min(load, 0.95) * law.pull_off_force());
      Agglomerate s = spheres({Vector3(R + offset, 0, 0), Vector3(R + offset + 2 * a + gap, 0, 0)}, a);
      s.state.contacts.push_back(make_bond(law, 0, 1, s.state.position[1] - s.state.position[0], a, a, 0));
      Stabilised integrator(model, s, {0.02, displacement}, seeded(6));
      const double relaxation = drag_coefficient(1e-3, a) / law.normal_stiffness();
      while (s.state.time < std::max(1000 * relaxation, 2.5 * fastest_interval(displacement))) integrator.step(1e9);
      EXPECT_EQ(s.state.contacts.size(), load < 1 ? 1u : 0u) << "load " << load << " at " << displacement << " a";
    }
  }
}

}  // namespace
