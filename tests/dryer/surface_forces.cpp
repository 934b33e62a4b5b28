// Forces between surfaces in the dryer.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "common/agglomerate/bond.hpp"
#include "dryer/brownian.hpp"
#include "dryer/drag.hpp"
#include "dryer/inertial.hpp"
#include "dryer/liquid_volume.hpp"
#include "dryer/stabilised.hpp"
#include "tests/dryer/in_salt.hpp"
#include "tests/long_version.hpp"
#include "tests/seeds.hpp"

using namespace crumble;
using namespace crumble::dryer;
using namespace crumble::dryer::samples;

namespace {

TEST(LiquidVolume, of_two_spheres_in_closed_form) {
  EXPECT_EQ(shared_volume(3, 1, 4), 0);
  EXPECT_NEAR(shared_volume(3, 1, 1.5), 4 * std::numbers::pi / 3, 1e-15);
  EXPECT_NEAR(shared_volume(1, 3, 1.5), 4 * std::numbers::pi / 3, 1e-15);
  // Equal spheres: pi (4 R + d)(2 R - d)^2/12.
  EXPECT_NEAR(shared_volume(1, 1, 0.5), std::numbers::pi * 4.5 * 1.5 * 1.5 / 12, 1e-14);
  for (const double d : {2.0, 4.0})  // continuous at both ends
    EXPECT_NEAR(shared_volume(3, 1, d * (1 - 1e-9)), shared_volume(3, 1, d), 1e-7);
  const Agglomerate s = spheres({Vector3(0, 0, 0), Vector3(50e-9, 0, 0)});
  EXPECT_NEAR(liquid_volume(s.particles, s.state, 100e-9) / liquid_volume(s.particles, 100e-9), 1, 1e-12);
  EXPECT_NEAR(liquid_volume(s.particles, s.state, 5e-9), 0, 1e-38);
}

TEST(SurfacePairs, salt_is_concentrated_by_the_liquid_that_is_left_within_a_tenth_of_a_per_cent) {
  const SurfaceForces f = forces(4.6e-21, 0.03, 10);
  for (const double left : {1.0, 0.7, 0.11, 0.005})
    EXPECT_NEAR(stepped_ionic_strength(f, 1e-20, left * 1e-20) * left / 10, 1, 1.01e-3);
  EXPECT_EQ(stepped_ionic_strength(f, 1e-20, 0), 5400);
}

// A cloud in which gaps are from overlaps to beyond the range, a third of the touching pairs bonded.
struct Cloud {
  Agglomerate state;
  DryingModel model;
  BondLaws bonds;
  Cloud(const SurfaceForces& f, bool unequal)
      : state(cloud(unequal)), model(in_bulk(f)), bonds(model.contact, model.material, state.particles.radius) {
    const auto& x = state.state.position;
    for (std::int32_t i = 0; i < std::ssize(x); i += 2) {
      const Vector3 D = x[i + 1] - x[i];
      const double a_i = state.particles.radius[i], a_j = state.particles.radius[i + 1];
      if (D.norm() < a_i + a_j + 0.02e-9 && i % 3 == 0)
        state.state.contacts.push_back(make_bond(bonds(i, i + 1), i, i + 1, D, a_i, a_j, 0));
    }
  }
  Cloud(const Cloud&) = delete;

 private:
  static Agglomerate cloud(bool unequal) {
    std::mt19937_64 random(3);
    const auto any = [&] { return 2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1; };
    std::vector<Vector3> x;
    for (int k = 0; k < 60; ++k) {
      x.push_back(60e-9 * Vector3(any(), any(), any()));
      // A partner at a gap between -0.2 and 2 nm.
      const Vector3 way(any(), any(), any());
      x.push_back(x.back() + (2 * a + (0.9 + 1.1 * any()) * 1e-9) * way.normalized());
    }
    Agglomerate s = spheres(x);
    if (unequal)
      for (std::size_t p = 0; p < x.size(); ++p) s.particles.radius[p] = p % 2 ? 9.7e-9 : 10.3e-9;
    return s;
  }
};

struct Case {
  const char* name;
  SurfaceForces forces;
  bool unequal;
};
SurfaceForces retarded() {
  SurfaceForces f = forces(9.85e-21, 0.05, 10);
  f.retardation_wavelength = 100e-9;
  return f;
}

class Block : public ::testing::TestWithParam<Case> {};

TEST_P(Block, has_the_forces_of_the_slow_sum) {
  const Cloud cloud(GetParam().forces, GetParam().unequal);
  const auto count = cloud.state.particles.size();
  SurfacePairs pairs(GetParam().forces, cloud.model.droplet, cloud.bonds, cloud.state.particles, 0);
  pairs.update(cloud.state.state, 1);
  ASSERT_GT(pairs.pairs().size(), 60u);
  SurfaceBlock block;
  block.begin(pairs.laws());
  std::vector<Position> position;
  for (const Vector3& x : cloud.state.state.position) position.push_back(dryer::position(x));
  const double F_po = pull_off_force(cloud.model.material, a);
  double worst = 0, largest = 0;
  // A pair at a time: deep overlaps would hide the rest of a sum.
  for (const Pair& pair : pairs.pairs()) {
    const auto& bonds = cloud.state.state.contacts;
    const bool bonded =
        std::any_of(bonds.begin(), bonds.end(), [&](const Contact& c) { return c.i == pair.i && c.j == pair.j; });
    const double a_i = cloud.state.particles.radius[pair.i], a_j = cloud.state.particles.radius[pair.j];
    const Vector3 D = cloud.state.state.position[pair.j] - cloud.state.state.position[pair.i];
    const double gap = D.norm() - a_i - a_j;
    if (gap < -3e-10) continue;
    block.begin(pairs.laws());
    block.add(pair.i, pair.j, pairs.laws()(pair.i, pair.j), a_i, a_j, bonded);
    std::vector<Quad, Eigen::aligned_allocator<Quad>> force(count, Quad(0.0f));
    block.add_forces(position.data(), force.data());
    const PairForces law = pairs.laws()(pair.i, pair.j);
    const double tension = bonded ? law.bonded_tension(gap) : law.open_tension(gap);
    const Quad f = force[pair.i];
    worst = std::max(worst, (Vector3(f[0], f[1], f[2]) - tension * D.normalized()).norm() / F_po);
    largest = std::max(largest, std::abs(tension) / F_po);
    const Quad g = force[pair.j];
    for (int k = 0; k < 3; ++k) EXPECT_EQ(f[k], -g[k]);
  }
  EXPECT_LT(worst, 2e-4);
  EXPECT_GT(largest, GetParam().forces.hamaker > 0 ? 0.5 : 0.01) << "to compare something";
  std::printf("%s: worst %.1e of the pull-off force, %zu pairs\n", GetParam().name, worst, pairs.pairs().size());

  // All at once: the slow sum over bonded and open pairs.
  Frame shallow = cloud.state.state;
  std::vector<Vector3> slow(count, Vector3::Zero());
  pairs.add_forces(shallow, slow);
  block.begin(pairs.laws());
  for (const Pair& pair : pairs.pairs())
    block.add(pair.i, pair.j, pairs.laws()(pair.i, pair.j), cloud.state.particles.radius[pair.i],
              cloud.state.particles.radius[pair.j],
              std::any_of(shallow.contacts.begin(), shallow.contacts.end(),
                          [&](const Contact& c) { return c.i == pair.i && c.j == pair.j; }));
  std::vector<Quad, Eigen::aligned_allocator<Quad>> fast(count, Quad(0.0f));
  block.add_forces(position.data(), fast.data());
  for (std::size_t p = 0; p < count; ++p)
    EXPECT_LT((Vector3(fast[p][0], fast[p][1], fast[p][2]) - slow[p]).norm(), 2e-4 * (F_po + slow[p].norm())) << p;
}

INSTANTIATE_TEST_SUITE_P(, Block,
                         ::testing::Values(Case{"attraction_and_repulsion", forces(9.85e-21, 0.04, 100), false},
                                           Case{"unequal_spheres", forces(9.85e-21, 0.04, 100), true},
                                           Case{"retarded", retarded(), false},
                                           Case{"repulsion_alone", forces(0, 0.06, 1), false},
                                           Case{"attraction_alone", forces(4.6e-21, 0, 1), false}),
                         [](const auto& one) { return one.param.name; });

TEST(SurfacePairs, what_the_liquid_has_left_feels_nothing) {
  const DryingModel model = in_bulk(forces(9.85e-21, 0.04, 100));
  const Agglomerate s = spheres({Vector3(0, 0, 0), Vector3(20.5e-9, 0, 0), Vector3(41e-9, 0, 0)});
  const BondLaws bonds(model.contact, model.material, s.particles.radius);
  SurfacePairs pairs(*model.surface_forces, {50e-9, 1, 0}, bonds, s.particles, 0);
  pairs.update(s.state, 41.1e-9);
  const std::vector<Pair> all{{0, 1}, {1, 2}};
  ASSERT_EQ(pairs.pairs(), all);
  pairs.update(s.state, 40.9e-9);  // the centre of the third is outside
  EXPECT_EQ(pairs.pairs(), std::vector<Pair>(1, {0, 1}));
  std::vector<Vector3> force(3, Vector3::Zero());
  pairs.add_forces(s.state, force);
  EXPECT_EQ(force[2], Vector3::Zero());
  EXPECT_NE(force[0], Vector3::Zero());
  EXPECT_EQ(force[0], -force[1]);
}

TEST(SurfaceForces, a_step_is_short_enough_for_the_stiffest_of_contact_and_surface_forces) {
  DryingModel model = in_bulk(forces(9.85e-21, 0.04, 100));
  DryingModel without = model;
  without.surface_forces.reset();
  const double usual = Brownian::short_step(without, a, 0.15);
  EXPECT_LE(Brownian::short_step(model, a, 0.15), usual);
  // A soft contact is less stiff than van der Waals forces that end at its pull-off force.
  model.material.youngs_modulus = without.material.youngs_modulus = 1e9;
  const std::vector<double> radius{a, a};
  const BondLaws bonds(model.contact, model.material, radius);
  const SurfaceForceLaws laws(*model.surface_forces, bonds, radius);
  EXPECT_GT(laws.largest_stiffness(), bonds(0, 1).normal_stiffness());
  EXPECT_LE(Brownian::short_step(model, a, 0.15),
            0.15 * drag_coefficient(model.viscosity, a) / laws.largest_stiffness());
}

// Two particles let go 1.5 nm apart move as the law pulls, without noise to speak of.
TEST(SurfaceForces, all_integrators_move_a_pair_as_its_law_says) {
  DryingModel model = in_bulk(forces(9.85e-21, 0.0, 100));
  model.thermal_energy = 1e-12 * kT;
  const double start = 1.5e-9, end = 1.2e-9;
  const std::vector<double> radius{a, a};
  const BondLaws bonds(model.contact, model.material, radius);
  const SurfaceForceLaws laws(*model.surface_forces, bonds, radius);
  // dh/dt = -2 tension/zeta.
  double expected = 0;
  constexpr int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    const double h = start + (end - start) * (k + 0.5) / steps;
    expected += (start - end) / steps * drag_coefficient(model.viscosity, a) / (2 * laws(0, 1).open_tension(h));
  }
  const auto time_of = [&](auto&& integrator, Agglomerate& s) {
    while ((s.state.position[1] - s.state.position[0]).norm() > 2 * a + end) integrator.step(1e9);
    return s.state.time;
  };
  const auto pair = [&] { return spheres({Vector3(0, 0, 0), Vector3(2 * a + start, 0, 0)}); };
  Agglomerate s = pair(), t = pair(), u = pair();
  EXPECT_NEAR(time_of(Brownian(model, s, 1, {0.15, 6}), s) / expected, 1, 0.05);
  EXPECT_NEAR(time_of(Brownian(model, t, 1, {0.15, 0}), t) / expected, 1, 0.01);
  const double step = Inertial::recommended_step(model, u.particles);
  EXPECT_NEAR(time_of(Inertial(model, u, step, 1), u) / expected, 1, 0.02);
  model.thermal_energy = 0;
  Agglomerate v = pair();
  Stabilised stabilised(model, v, {});
  while ((v.state.position[1] - v.state.position[0]).norm() > 2 * a + end)
    stabilised.step(v.state.time + 0.002 * expected);
  EXPECT_NEAR(v.state.time / expected, 1, 0.01);
  // On, until it has come to rest where contact law and double layers balance.
  for (int k = 0; k < 200; ++k) stabilised.step(v.state.time + 0.1 * expected);
  ASSERT_EQ(v.state.contacts.size(), 1u);
  const double gap = (v.state.position[1] - v.state.position[0]).norm() - 2 * a;
  EXPECT_NEAR(gap, bonds(0, 1).equilibrium_gap(), 1e-3 * a);
}

// A pair of weak attraction, without charge, in a closed sphere that does not shrink: how often it is nearer than h_j,
// by the Boltzmann distribution of capillary and surface energy together. Of centres at r and q from the middle the
// distance s has the density s/(2 r q) from |r - q| to r + q.
TEST(SurfaceForces, a_pair_in_a_closed_sphere_has_the_Boltzmann_distribution) {
  const double R = 22e-9;
  DryingModel model = in_bulk(forces(2.2e-21, 0, 100));
  model.material.surface_energy = surface_energy_of(2.2e-21);
  model.droplet = {R, 1e9, 1.75e-4};
  const std::vector<double> radius{a, a};
  const BondLaws bonds(model.contact, model.material, radius);
  const SurfaceForceLaws laws(*model.surface_forces, bonds, radius);
  const PairForces law = laws(0, 1);
  const double near = law.attraction.joined_gap(), deepest = bonds(0, 1).equilibrium_gap() * 8;
  // Both centres must be in the liquid for surface forces to act; the capillary force keeps them 0.9 a inside.
  constexpr int places = 500, distances = 40000;
  const double width = R / places, longest = 2 * R;
  std::vector<double> cumulated{0};
  const double first = 2 * a + deepest, step = (longest - first) / distances;
  for (int k = 0; k < distances; ++k) {
    const double s = first + (k + 0.5) * step, gap = s - 2 * a;
    // Open and bonded pairs have the same energy: contact law and surface forces together.
    const double U = gap < law.range ? law.open_energy(gap) : 0;
    cumulated.push_back(cumulated.back() + s * std::exp(-U / kT) * step);
  }
  const auto up_to = [&](double s) {
    const double x = std::clamp((s - first) / step, 0.0, static_cast<double>(distances));
    const auto k = std::min(static_cast<std::size_t>(x), static_cast<std::size_t>(distances - 1));
    return cumulated[k] + (x - static_cast<double>(k)) * (cumulated[k + 1] - cumulated[k]);
  };
  std::vector<double> weight(places);
  for (int k = 0; k < places; ++k)
    weight[k] =
        (k + 0.5) * width * std::exp(-capillary_energy(model.droplet.surface_tension, a, (k + 0.5) * width - R) / kT);
  double inside = 0, all = 0;
  for (int i = 0; i < places; ++i)
    for (int j = 0; j < places; ++j) {
      const double r = (i + 0.5) * width, q = (j + 0.5) * width, both = weight[i] * weight[j];
      const double low = std::abs(r - q), high = r + q;
      all += both * (up_to(high) - up_to(low));
      inside += both * std::max(up_to(std::min(high, 2 * a + near)) - up_to(low), 0.0);
    }
  const double expected = inside / all;
  constexpr int runs = 16;
  double mean = 0, square = 0;
  for (std::uint64_t seed = 0; seed < runs; ++seed) {
    Agglomerate s = spheres({Vector3(-11e-9, 0, 0), Vector3(11e-9, 0, 0)});
    Brownian integrator(model, s, seeded(seed), {0.15, 4});
    const auto steps = static_cast<int>((long_version() ? 4e-5 : 4e-6) / integrator.long_step());
    double share = 0;
    for (int k = -steps / 4; k < steps; ++k) {
      integrator.step(1e9);
      if (k >= 0) share += ((s.state.position[1] - s.state.position[0]).norm() < 2 * a + near ? 1.0 : 0.0) / steps;
    }
    mean += share / runs;
    square += share * share / runs;
  }
  const double error = std::sqrt((square - mean * mean) / (runs - 1));
  std::printf("share within h_j: %.4f +- %.4f, expected %.4f\n", mean, error, expected);
  // Of 16 runs (Student's t) five standard errors: 2e-4 by chance; 3 % for the step.
  expect_near("share over that of Boltzmann", mean / expected, 1, 5 * error / expected + 0.03);
  expect_within("its error", error / mean, 0, 0.1);
}

}  // namespace
