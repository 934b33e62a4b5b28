#include <fmt/core.h>
#include <gtest/gtest.h>

#include "common/agglomerate/morphology.hpp"
#include "dryer/implicit.hpp"
#include "dryer/inertial.hpp"
#include "dryer/stabilised.hpp"
#include "tests/dryer/samples.hpp"
#include "tests/seeds.hpp"

using namespace crumble;
using namespace crumble::dryer;
using namespace crumble::dryer::samples;

namespace {

constexpr double a = 10e-9;

// What holds for both integrators without inertia.
template <class I>
class Overdamped : public testing::Test {
 protected:
  static auto control(double largest_displacement, double contact_precision) {
    if constexpr (std::is_same_v<I, Implicit>)
      return ImplicitControl{largest_displacement, contact_precision};
    else
      return StabilisedControl{largest_displacement};
  }
  // Implicit steps do not know how stiff contacts are; evaluations of stabilised ones go with the root of it.
  static constexpr std::int64_t most_steps = std::is_same_v<I, Implicit> ? 100000 : 1000000;
  static IntegratorStatistics dry(const DryingModel& model, Agglomerate& state, double largest_displacement = 0.01,
                                  double contact_precision = 1e-4) {
    I integrator(model, state, control(largest_displacement, contact_precision));
    while (state.state.time < model.droplet.lifetime) integrator.step(model.droplet.lifetime);
    return integrator.statistics();
  }
};

struct Name {
  template <class I>
  static std::string GetName(int) {
    return std::is_same_v<I, Implicit> ? "implicit" : "stabilised";
  }
};
using Both = testing::Types<Implicit, Stabilised>;
TYPED_TEST_SUITE(Overdamped, Both, Name);

TYPED_TEST(Overdamped, ends_with_the_same_granule_as_the_inertial_reference) {
  // 25 particles in a droplet of the same solids fraction and front speed as Table 2, full JKR stiffness.
  DryingModel model = hollow();
  model.droplet = {129e-9, 1.26e-5, 1.75e-4};
  for (const std::uint64_t seed : {1, 2}) {
    Agglomerate fast = start(25, 129e-9, seeded(seed)), reference = fast;
    const auto statistics = this->dry(model, fast);
    Inertial integrator(model, reference, 1.5 * Inertial::recommended_step(model, reference.particles));
    while (reference.state.time < model.droplet.lifetime) integrator.step(model.droplet.lifetime);
    const Morphology m = morphology(fast.particles, fast.state), r = morphology(reference.particles, reference.state);
    expect_near("d_c", m.extent.diameter() / r.extent.diameter(), 1, 0.01);
    expect_near("contacts", static_cast<double>(m.contacts) / static_cast<double>(r.contacts), 1, 0.05);
    expect_within("deepest overlap", statistics.largest_overlap, 0, 0.02);
  }
}

TYPED_TEST(Overdamped, one_particle_ends_at_the_centre_of_the_droplet) {
  const DryingModel model = hollow();
  Agglomerate s = spheres({Vector3(30e-9, -100e-9, 60e-9)});
  this->dry(model, s);
  EXPECT_LT(s.state.position[0].norm(), a);
  EXPECT_EQ(s.state.time, model.droplet.lifetime);
}

TYPED_TEST(Overdamped, two_particles_meet_and_bond) {
  const DryingModel model = hollow();
  Agglomerate s = spheres({Vector3(100e-9, 3e-9, 0), Vector3(-80e-9, 0, 5e-9)});
  this->dry(model, s);
  ASSERT_EQ(s.state.contacts.size(), 1u);
  const BondLaw law(model.contact, model.material, a, a);
  EXPECT_NEAR(s.state.contacts[0].gap, law.equilibrium_gap(), 0.02 * std::abs(law.equilibrium_gap()));
}

TYPED_TEST(Overdamped, particle_that_nothing_reaches_never_moves) {
  DryingModel model = hollow();
  model.droplet.surface_tension = 0;
  Agglomerate s = spheres({Vector3(100e-9, 0, 0), Vector3(10e-9, 0, 0)});
  const auto before = s.state.position;
  this->dry(model, s);
  EXPECT_EQ(s.state.position, before);
}

TYPED_TEST(Overdamped, front_faster_than_the_capillary_speed_leaves_particles_dry) {
  DryingModel model = hollow();
  model.droplet.lifetime = 2.1e-7;  // 0.5 m/s against sigma/(3 mu) = 0.058 m/s
  Agglomerate s = start(50, 215e-9, seeded(1));
  const auto before = s.state.position;
  this->dry(model, s);
  for (std::size_t p = 0; p < before.size(); ++p) {
    EXPECT_TRUE(s.state.position[p].allFinite());
    EXPECT_GT(s.state.position[p].norm(), before[p].norm() - 2.5 * a);
  }
}

TYPED_TEST(Overdamped, takes_stiffness_from_soft_to_hard_by_a_factor_of_1e6) {
  for (const double modulus : {3.4e7, 3.4e10, 3.4e13}) {
    DryingModel model = hollow();
    model.material.youngs_modulus = modulus;
    model.droplet = {100e-9, 2.1e-5, 1.75e-4};
    Agglomerate s = start(12, 100e-9, seeded(1));
    const auto statistics = this->dry(model, s, 0.05);
    expect_within(fmt::format("contacts at {} Pa", modulus), s.state.contacts.size(), 11, unbounded);
    for (const Vector3& x : s.state.position) EXPECT_TRUE(x.allFinite()) << modulus;
    EXPECT_LT(statistics.steps, this->most_steps) << modulus;
  }
}

TYPED_TEST(Overdamped, ten_times_too_long_steps_change_the_result_by_no_more_than_its_own_error_says) {
  DryingModel model = hollow();
  model.droplet = {129e-9, 1.26e-5, 1.75e-4};
  Agglomerate fine = start(25, 129e-9, seeded(3)), coarse = fine;
  this->dry(model, fine);
  this->dry(model, coarse, 0.1, 1e-3);
  const Morphology f = morphology(fine.particles, fine.state), c = morphology(coarse.particles, coarse.state);
  expect_near("d_c", c.extent.diameter() / f.extent.diameter(), 1, 0.02);
  expect_near("contacts", c.contacts - f.contacts, 0, 2);
}

TYPED_TEST(Overdamped, contact_torn_open_is_lost_and_made_again_only_at_zero_gap_without_its_history) {
  const DryingModel model = hollow();
  const BondLaw law(model.contact, model.material, a, a);
  Agglomerate s = spheres({Vector3(0, 0, 0), Vector3(2 * a + law.lost_gap() * 1.01, 0, 0)});
  s.state.contacts = {
      Contact{.i = 0, .j = 1, .gap = law.lost_gap() * 0.99, .sliding = Vector3(0, 1e-11, 0), .born = 7}};
  TypeParam integrator(model, s, {});
  integrator.step(1e-16);
  EXPECT_EQ(integrator.statistics().contacts_lost, 1);
  EXPECT_TRUE(s.state.contacts.empty());
  s.state.position[1].x() = 2 * a + 0.1 * law.lost_gap();  // near, but not touching
  integrator.step(2e-16);
  EXPECT_TRUE(s.state.contacts.empty());
  s.state.position[1].x() = 2 * a - 1e-16;
  const std::int64_t before = s.state.step;
  integrator.step(3e-16);
  ASSERT_EQ(s.state.contacts.size(), 1u);
  EXPECT_EQ(s.state.contacts[0].sliding.norm(), 0);
  // One step of the integrator is several evaluations of the stabilised one.
  constexpr bool one_evaluation = std::is_same_v<TypeParam, Implicit>;
  EXPECT_GE(s.state.contacts[0].born, one_evaluation ? s.state.step : before);
  EXPECT_LE(s.state.contacts[0].born, s.state.step);
}

TYPED_TEST(Overdamped, unequal_spheres_dry_too) {
  const DryingModel model = hollow();
  std::vector<double> radius;
  for (int p = 0; p < 30; ++p) radius.push_back(p % 3 == 0 ? 20e-9 : p % 3 == 1 ? 10e-9 : 2e-9);  // ratio 10
  Agglomerate s = random_suspension(radius, 1300, 150e-9, seeded(5));
  this->dry(model, s, 0.1);
  expect_within("contacts", s.state.contacts.size(), 21, unbounded);
  double deepest = 0;
  for (const Contact& c : s.state.contacts) deepest = std::max(deepest, -c.gap / pair_radius(radius[c.i], radius[c.j]));
  expect_within("deepest overlap", deepest, 0, 0.1);
}

// Water at 300 K pulls 410 times as hard as the paper's reduced surface tension: 20 times what a bond bears at 10 nm.
// JKR under 20 F_po rests at a gap of -0.044 a; sums of several neighbours go deeper.
TYPED_TEST(Overdamped, real_surface_tension_presses_a_granule_together_without_harm) {
  DryingModel model = hollow();
  model.droplet = {100e-9, 1e-5, 0.0717};
  Agglomerate s = start(12, 100e-9, seeded(1));
  const auto statistics = this->dry(model, s, 0.05);
  for (const Vector3& x : s.state.position) EXPECT_TRUE(x.allFinite());
  // Of 12 starts one lost two particles on the way (implicit); of the overlap they had 0.06 to 0.2 (stabilised).
  expect_within("largest piece", morphology(s.particles, s.state).largest_fragment, 8, 12);
  expect_within("deepest overlap", statistics.largest_overlap, 0, 0.5);
  EXPECT_LT(statistics.steps, this->most_steps);
}

TEST(Implicit, cundall_strack_bonds_hold_the_granule_together) {
  DryingModel model = hollow();
  model.contact.normal = NormalLaw::cundall_strack;
  model.droplet = {129e-9, 1.26e-5, 1.75e-4};
  Agglomerate s = start(25, 129e-9, seeded(1));
  Implicit integrator(model, s, {});
  while (s.state.time < model.droplet.lifetime) integrator.step(model.droplet.lifetime);
  // One of 20 droplets lost a particle: three by chance 2e-5.
  expect_within("fragments", morphology(s.particles, s.state).fragments, 1, 3);
}

}  // namespace
