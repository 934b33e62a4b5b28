// The states and choices that break a dryer, each with every integrator that it concerns, to the end of the droplet:
// finite, every particle kept, no overlap deeper than stated, in a bounded number of steps; and the same bits after a
// restart in the middle of each. Further hard cases stand beside what they concern: dryer/ACCURACY.md lists them all.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>

#include "common/agglomerate/bond.hpp"
#include "common/agglomerate/morphology.hpp"
#include "dryer/brownian.hpp"
#include "dryer/drag.hpp"
#include "dryer/implicit.hpp"
#include "dryer/inertial.hpp"
#include "dryer/stabilised.hpp"
#include "tests/dryer/samples.hpp"
#include "tests/long_version.hpp"
#include "tests/seeds.hpp"

using namespace crumble;
using namespace crumble::dryer;
using namespace crumble::dryer::samples;

namespace {

constexpr double a = 10e-9, kT = boltzmann_constant * 300;

enum class Method { overdamped, stabilised, inertial, brownian };

struct HardCase {
  DryingModel model;
  Agglomerate state;
  double deepest = 0.05;  // overlap that the capillary force and the noise can press a bond to, in the pair's radius
  double thrown = 5;      // as far beyond the droplet may a particle end, a
};

std::unique_ptr<Integrator> integrator(Method method, const DryingModel& model, Agglomerate& state) {
  if (method == Method::overdamped)
    return std::make_unique<Implicit>(model, state, ImplicitControl{.largest_displacement = 0.05});
  if (method == Method::stabilised)
    return std::make_unique<Stabilised>(model, state, StabilisedControl{.largest_displacement = 0.05});
  if (method == Method::brownian) return std::make_unique<Brownian>(model, state, seeded(1), BrownianControl{});
  return std::make_unique<Inertial>(model, state, Inertial::recommended_step(model, state.particles), seeded(1));
}

// A droplet that is gone in a microsecond: its front is as fast as the capillary force can follow.
DryingModel shrinking(double radius) {
  DryingModel model = hollow();
  model.droplet = {radius, 1e-6, 1.75e-4};
  return model;
}

// Bonds whatever is as far apart as bonds at rest are.
HardCase bonded(const DryingModel& model, std::vector<Vector3> position) {
  HardCase out{model, spheres(position)};
  const BondLaw law(model.contact, model.material, a, a);
  const auto number = static_cast<std::int32_t>(position.size());
  for (std::int32_t i = 0; i < number; ++i)
    for (std::int32_t j = i + 1; j < number; ++j)
      if ((position[j] - position[i]).norm() < 2 * a + 0.5 * law.lost_gap())
        out.state.state.contacts.push_back(make_bond(law, i, j, position[j] - position[i], a, a, 0));
  return out;
}

double pitch() { return 2 * a + BondLaw({}, {}, a, a).equilibrium_gap(); }

HardCase pair_at_gap(double gap) {
  HardCase out{shrinking(40e-9), spheres({Vector3(0, 0, 30e-9), Vector3(2 * a + gap, 0, 30e-9)})};
  out.deepest = std::max(out.deepest, -1.0001 * gap / a);  // what it begins with gets no deeper, to single precision
  return out;
}

HardCase chain(const ContactChoice& contact) {
  DryingModel model = shrinking(100e-9);
  model.contact = contact;
  std::vector<Vector3> x;
  for (int k = 0; k < 9; ++k) x.emplace_back((k - 4) * pitch(), 0, 0);
  return bonded(model, x);
}

HardCase raft() {
  std::vector<Vector3> x;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) x.emplace_back(i * pitch(), j * pitch(), 0);
  return bonded(shrinking(75e-9), x);
}

// An icosahedron whose neighbours touch, and a particle of half the radius inside it, off the centre.
HardCase shell(double droplet_radius) {
  std::vector<Vector3> x;
  const double golden = (1 + std::sqrt(5.0)) / 2, s = pitch() / 2;
  for (const double u : {-s, s})
    for (const double v : {-s, s})
      for (int k = 0; k < 3; ++k) {
        Vector3 corner = Vector3::Zero();
        corner[k] = u;
        corner[(k + 1) % 3] = golden * v;
        x.push_back(corner);
      }
  x.emplace_back(2e-9, 0, 0);
  HardCase out = bonded(shrinking(droplet_radius), x);
  out.state.particles.radius.back() = 5e-9;
  out.state.particles.mass.back() /= 8;
  return out;
}

HardCase of_ten_radii() {
  std::vector<double> radius(4, a);
  radius.resize(16, 0.1 * a);
  // Of 20 starts 0.028 +- 0.008, stabilised 0.046 +- 0.013.
  return {shrinking(60e-9), random_suspension(radius, 1300, 60e-9, seeded(5)), 0.12};
}

HardCase drops(int number, double lifetime, double thermal_energy) {
  HardCase out{shrinking(70e-9), start(number, 70e-9, seeded(1))};
  out.model.droplet.lifetime = lifetime;
  out.model.thermal_energy = thermal_energy;
  return out;
}

HardCase of_modulus(double modulus) {
  HardCase out = drops(6, 1e-6, 0);
  out.model.material.youngs_modulus = modulus;
  out.deepest = std::max(out.deepest, -2 * BondLaw({}, out.model.material, a, a).equilibrium_gap() / a);
  return out;
}

HardCase noisy(HardCase of, double thermal_energy = kT) {
  of.model.thermal_energy = thermal_energy;
  // At 1e4 times the diffusivity a pair approaches by 0.28 a (standard deviation) in one short step: four of them.
  of.deepest = std::max(of.deepest, thermal_energy > 100 * kT ? 1.1 : 0.3);
  // The farthest of eight, of 21 starts 3.4 +- 0.9, at most 5.7.
  if (thermal_energy > 100 * kT) of.thrown = 10;
  return of;
}

struct Named {
  const char* name;
  Method method;
  HardCase (*make)();
};

class Hard : public ::testing::TestWithParam<Named> {};

bool finite(const Frame& f) {
  return std::all_of(f.position.begin(), f.position.end(), [](const Vector3& x) { return x.allFinite(); });
}

TEST_P(Hard, case_dries_to_the_end) {
  const HardCase given = GetParam().make();
  Agglomerate state = given.state;
  const auto run = integrator(GetParam().method, given.model, state);
  const double end = run->front().end();
  while (state.state.time < end) {
    run->step(end);
    ASSERT_LT(run->statistics().steps, 20000000);
  }
  EXPECT_EQ(state.state.time, end);
  EXPECT_TRUE(finite(state.state));
  expect_within("deepest overlap", run->statistics().largest_overlap, 0, given.deepest);
  for (const Contact& c : state.state.contacts) EXPECT_NEAR(c.normal.norm(), 1, 1e-9);  // what a valid file needs
  // The last of the liquid pulls inwards only: nothing is thrown out.
  double farthest = 0;
  for (const Vector3& x : state.state.position) farthest = std::max(farthest, x.norm());
  expect_within("farthest beyond the droplet, a", (farthest - given.model.droplet.initial_radius) / a, -unbounded,
                given.thrown);
}

TEST_P(Hard, case_restarts_in_the_middle_to_the_same_bits) {
  const HardCase given = GetParam().make();
  Agglomerate state = given.state;
  const auto run = integrator(GetParam().method, given.model, state);
  const double end = run->front().end(), middle = 0.5 * end;
  while (state.state.time < middle) run->step(end);
  Agglomerate saved = state;
  const auto other = integrator(GetParam().method, given.model, saved);
  load(*other, save(*run));
  // As far as a restart could matter: the lists of neighbours are made anew several times.
  for (int k = 0; k < 2000 && state.state.time < end; ++k) {
    run->step(end);
    other->step(end);
  }
  EXPECT_EQ(state.state.time, saved.state.time);
  EXPECT_EQ(state.state.position, saved.state.position);
  ASSERT_EQ(state.state.contacts.size(), saved.state.contacts.size());
  for (std::size_t c = 0; c < state.state.contacts.size(); ++c)
    EXPECT_EQ(state.state.contacts[c].rolling, saved.state.contacts[c].rolling);
}

#define WITH_ALL(name, make)                                                  \
  Named{name "_overdamped", Method::overdamped, [] { return make; }},         \
      Named{name "_stabilised", Method::stabilised, [] { return make; }},     \
      Named{name "_inertial", Method::inertial, [] { return make; }}, Named { \
    name "_with_noise", Method::brownian, [] { return noisy(make); }          \
  }

constexpr ContactChoice free_to_roll{.twisting_limit_factor = 0, .rolling_limit_factor = 0};

INSTANTIATE_TEST_SUITE_P(
    Dryer, Hard,
    ::testing::Values(WITH_ALL("gap_of_1e_8_a", pair_at_gap(1e-8 * a)),
                      WITH_ALL("overlap_of_a_tenth", pair_at_gap(-0.1 * a)), WITH_ALL("straight_chain", chain({})),
                      WITH_ALL("straight_chain_without_rolling_resistance", chain(free_to_roll)),
                      WITH_ALL("coplanar_raft", raft()), WITH_ALL("one_particle", drops(1, 1e-6, 0)),
                      WITH_ALL("two_particles", drops(2, 1e-6, 0)), WITH_ALL("loose_particle_in_a_shell", shell(60e-9)),
                      WITH_ALL("radii_that_differ_by_ten", of_ten_radii()),
                      WITH_ALL("front_1e4_times_too_fast", drops(8, 2e-9, 0)),
                      WITH_ALL("modulus_100_times_smaller", of_modulus(3.4e7)),
                      WITH_ALL("modulus_1e4_times_larger", of_modulus(3.4e13)),
                      Named{"diffusivity_1e4_times_larger", Method::brownian,
                            [] { return noisy(drops(8, 1e-6, 0), 1e4 * kT); }}),
    [](const auto& given) { return std::string(given.param.name); });

TEST(HardCases, pairs_that_begin_too_deep_end_bonded_at_rest) {
  for (const Method method : {Method::overdamped, Method::inertial}) {
    HardCase given = pair_at_gap(-0.1 * a);
    const auto run = integrator(method, given.model, given.state);
    while (given.state.state.time < run->front().end()) run->step(run->front().end());
    ASSERT_EQ(given.state.state.contacts.size(), 1u);
    const double rest = BondLaw({}, {}, a, a).equilibrium_gap();
    EXPECT_NEAR(given.state.state.contacts[0].gap, rest, 0.02 * std::abs(rest)) << static_cast<int>(method);
  }
}

TEST(HardCases, coincident_centres_are_an_error_that_names_the_pair) {
  for (const Method method : {Method::overdamped, Method::inertial}) {
    HardCase given = pair_at_gap(-2 * a);
    try {
      const auto run = integrator(method, given.model, given.state);
      for (int k = 0; k < 1000; ++k) run->step(1);
      ADD_FAILURE() << "no error from method " << static_cast<int>(method);
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find("0-1"), std::string::npos) << error.what();
    }
  }
}

// Noise is added before forces are asked for, so centres are never exactly coincident: the pair is thrown apart, and
// what the run reports as its deepest overlap shows where it has been.
TEST(HardCases, coincident_centres_with_noise_stand_in_the_reported_overlap) {
  HardCase given = noisy(pair_at_gap(-2 * a));
  const auto run = integrator(Method::brownian, given.model, given.state);
  for (int k = 0; k < 10; ++k) run->step(1);
  EXPECT_TRUE(finite(given.state.state));
  expect_within("deepest overlap", run->statistics().largest_overlap, 1.9, 2);
}

// The shell stands dry around the liquid; what is loose inside is the only one that diffuses. From the centre it has 4
// nm to the wall and crosses them some hundred times.
TEST(HardCases, a_loose_particle_stays_in_its_shell_however_long_it_diffuses) {
  HardCase given = noisy(shell(15e-9));
  given.model.droplet = {8e-9, 1e6, 1.75e-4};
  for (std::size_t p = 0; p < 12; ++p) ASSERT_GT(given.state.state.position[p].norm(), 8e-9 + a);
  const auto run = integrator(Method::brownian, given.model, given.state);
  double farthest = 0;
  for (int k = 0; k < 1000; ++k) {
    run->step(1);
    farthest = std::max(farthest, given.state.state.position[12].norm());
  }
  expect_within("farthest, nm", 1e9 * farthest, 1, 6);
}

// Every bond begins with a twist that it cannot have by itself: thermal springs hold 0.03 rad, and of 1 rad five in six
// are left after the step. So a bond that is there before and after but hardly twisted was broken and made again in the
// step.
TEST(HardCases, a_bond_that_breaks_and_forms_again_within_a_step_forgets) {
  constexpr int pairs = 500;
  DryingModel model = hollow();
  model.droplet = {1e-3, 1e6, 0};
  model.contact.twisting_limit_factor = 1e9;
  std::vector<Vector3> x;
  for (int p = 0; p < pairs; ++p)
    for (const double along : {0.0, pitch()}) x.emplace_back(along, 1e-6 * p, 0);
  HardCase given = noisy(bonded(model, x));
  for (Contact& bond : given.state.state.contacts) bond.twisting = 1;
  const auto run = integrator(Method::brownian, given.model, given.state);
  run->step(1);
  int kept = 0, again = 0;
  for (const Contact& bond : given.state.state.contacts) {
    EXPECT_TRUE(bond.twisting > 0.5 || std::abs(bond.twisting) < 0.3) << bond.twisting;
    ++(bond.twisting > 0.5 ? kept : again);
  }
  expect_within("bonds kept", kept, 11, pairs);
  expect_within("bonds made again", again, 5, pairs);  // 26 in the mean: fewer than 5 are 1e-7 by chance
  // Lost for good or for a while: all that do not remember.
  EXPECT_GE(run->statistics().contacts_lost, pairs - kept);
  EXPECT_GE(run->statistics().contacts_made, again);
}

// At about the memory that a particle may have: what the state and the integrator hold, 600 bytes each. 20,000
// particles show it; the long version starts 100,000.
template <class Run>
void start_and_step_a_large_droplet(Run make) {
  const auto resident = [] {
    long pages = 0, own = 0;
    std::ifstream("/proc/self/statm") >> pages >> own;
    return own * sysconf(_SC_PAGESIZE);
  };
  const long before = resident();
  const int number = long_version() ? 100000 : 20000;
  const double radius = 32e-6 * std::cbrt(number / 1e5);  // 1 % of solids
  DryingModel model = hollow();
  model.droplet = {radius, 30e-3 * std::pow(radius / 32e-6, 2), 1.75e-4};
  Agglomerate state = random_suspension(std::vector<double>(number, 150e-9), 1300, radius, 1);
  const auto run = make(model, state);
  for (int k = 0; k < 20; ++k) run->step(model.droplet.lifetime);
  EXPECT_TRUE(finite(state.state));
  EXPECT_GT(run->statistics().particle_steps, 1000);
  EXPECT_LT(run->statistics().particle_steps, run->statistics().steps * number / 10) << "idle particles cost nothing";
#ifndef __SANITIZE_ADDRESS__  // which needs several times the memory
  EXPECT_LT(static_cast<double>(resident() - before) / number, 600);
#else
  (void)before;
#endif
}

TEST(HardCases, a_large_droplet_starts_and_steps_in_600_bytes_a_particle_by_implicit_steps) {
  start_and_step_a_large_droplet([](const DryingModel& model, Agglomerate& state) {
    return std::make_unique<Implicit>(model, state, ImplicitControl{.largest_displacement = 0.05});
  });
}

TEST(HardCases, a_large_droplet_starts_and_steps_in_600_bytes_a_particle_by_stabilised_steps) {
  start_and_step_a_large_droplet([](const DryingModel& model, Agglomerate& state) {
    return std::make_unique<Stabilised>(model, state, StabilisedControl{.largest_displacement = 0.05});
  });
}

}  // namespace
