#include "dryer/brownian.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/agglomerate/bond.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/numerics/noise.hpp"
#include "dryer/brownian_path.hpp"
#include "dryer/drag.hpp"
#include "dryer/inertial.hpp"
#include "dryer/pair_statistics.hpp"
#include "tests/dryer/samples.hpp"

using namespace crumble;
using namespace crumble::samples;

// Statistical tests compare a mean with its expectation within 5 of its standard errors: one false alarm in 1.7 million
// (and none at all once it has passed, since the seeds are fixed).
namespace {

constexpr double a = 10e-9, kT = boltzmann_constant * 300;

DryingModel diffusing() {
  DryingModel model = hollow();
  model.thermal_energy = kT;
  return model;
}

// No surface anywhere near.
DryingModel in_bulk() {
  DryingModel model = diffusing();
  model.droplet = {1e-3, 1e6, 0};
  return model;
}

double D() { return kT / drag_coefficient(1e-3, a); }

// Far from each other.
Agglomerate lonely(int number) {
  std::vector<Vector3> position;
  for (int p = 0; p < number; ++p) position.emplace_back(1e-6 * p, 0, 0);
  return spheres(position);
}

TEST(BondBlock, is_the_law_of_the_reference) {
  const DryingModel model;
  const BondLaw law(model.contact, model.material, a, a);
  Agglomerate s = start(20, 100e-9, 3);
  BondBlock block;
  MotionBlock motion;
  motion.resize(20);
  block.clear(20);
  std::vector<Contact> bonds;
  // A chain at rest: 19 bonds, in three registers.
  const double pitch = 2 * a + law.equilibrium_gap();
  for (std::int32_t p = 0; p < 20; ++p) s.state.position[p] = Vector3(pitch * p, 0, 0);
  for (std::int32_t p = 0; p < 19; ++p) {
    bonds.push_back(make_bond(law, p, p + 1, s.state.position[p + 1] - s.state.position[p], a, a, 0));
    block.add(bonds.back(), p, p + 1, law, a, a, law.lost_gap());
  }
  std::size_t at_limit = 0;
  for (int step = 0; step < 200; ++step) {
    std::vector<Vector3> displacement(20), rotation(20);
    for (std::int32_t p = 0; p < 20; ++p) {
      const auto x = random_normals(1, Purpose::brownian_path, p, step),
                 y = random_normals(2, Purpose::radius, p, step);
      // Steps of 5 pm and 2 mrad about a place that pulls back, so that bonds live and springs yield.
      displacement[p] = 5e-12 * Vector3(x[0], x[1], x[2]) + 0.2 * (Vector3(pitch * p, 0, 0) - s.state.position[p]);
      rotation[p] = 2e-3 * Vector3(x[3], y[0], y[1]);
      s.state.position[p] += displacement[p];
      motion.position[p] = position(s.state.position[p]);
      motion.moved[p] = six_vector((Vector6() << displacement[p], rotation[p]).finished());
    }
    block.advance(motion);
    std::vector<Vector3> force(20, Vector3::Zero()), torque(20, Vector3::Zero());
    for (Contact& bond : bonds) {
      advance(bond, law,
              {s.state.position[bond.j] - s.state.position[bond.i], displacement[bond.j] - displacement[bond.i],
               rotation[bond.i], rotation[bond.j], a, a});
      at_limit += bond.at_limit != 0;
      force[bond.j] += force_on_j(bond);
      force[bond.i] -= force_on_j(bond);
      torque[bond.i] += torque_on_i(bond, lever_arm(bond, a, a));
      torque[bond.j] += torque_on_j(bond, lever_arm(bond, a, a));
    }
    ASSERT_TRUE(block.lost().empty());
    for (std::int32_t p = 0; p < 20; ++p) {
      const auto load = block.load_on(p);
      for (int k = 0; k < 3; ++k) {
        // Single precision: 1e-7 of the distance between centres is 7e-5 of the gap at pull-off.
        ASSERT_NEAR(load[k], force[p][k], 2e-4 * law.pull_off_force()) << step;
        ASSERT_NEAR(load[4 + k], torque[p][k], 2e-4 * law.pull_off_force() * a) << step;
      }
    }
  }
  EXPECT_GT(at_limit, 100u);  // springs did yield
}

TEST(BondBlock, its_normal_force_is_that_of_the_law_from_pull_off_to_deep_compression) {
  const BondLaw law(ContactChoice{}, Material{}, a, a);
  for (double gap = 0.999 * law.lost_gap(); gap > -100 * law.jkr.length; gap -= 0.01 * law.jkr.length) {
    BondBlock block;
    MotionBlock motion;
    motion.resize(2);
    block.clear(2);
    block.add(make_bond(law, 0, 1, Vector3(2 * a, 0, 0), a, a, 0), 0, 1, law, a, a, law.lost_gap());
    motion.position[1].at[0] = 2 * a + gap;
    block.advance(motion);
    const double tension = law.jkr.tension(gap);
    // The polynomial's error, and rounding of the gap: 1e-7 of the distance is 7e-5 of the gap at pull-off.
    ASSERT_NEAR(-block.load_on(1)[0], tension, 2e-4 * std::max(std::abs(tension), law.pull_off_force())) << gap;
  }
}

TEST(BondBlock, a_bond_beyond_its_reach_is_named_and_pulls_no_more) {
  const BondLaw law(ContactChoice{}, Material{}, a, a);
  BondBlock block;
  MotionBlock motion;
  motion.resize(2);
  block.clear(2);
  block.add(make_bond(law, 0, 1, Vector3(2 * a, 0, 0), a, a, 0), 0, 1, law, a, a, law.lost_gap());
  motion.position[1].at[0] = 2 * a + 1.01 * law.lost_gap();
  block.advance(motion);
  EXPECT_EQ(block.lost(), std::vector<std::int32_t>{0});
  EXPECT_EQ(block.load_on(1)[0], 0);
}

TEST(Brownian, mean_square_displacement_is_6_D_t) {
  const int number = 300;
  Agglomerate s = lonely(number);
  const auto origin = s.state.position;
  const DryingModel model = in_bulk();
  Brownian integrator(model, s, 1, {});
  for (int k = 0; k < 200; ++k) integrator.step(1e9);
  double sum = 0;
  for (int p = 0; p < number; ++p) sum += (s.state.position[p] - origin[p]).squaredNorm();
  const double expected = 6 * D() * s.state.time;
  // A sum of 3 squared normals a particle: relative standard error sqrt(2/(3 N)).
  EXPECT_NEAR(sum / number / expected, 1, 5 * std::sqrt(2.0 / (3 * number)));
}

// Bonded pairs in which only twisting is resisted, and elastically: the twist is an Ornstein-Uhlenbeck process,
//   <phi^2> = (kT/k_t) (1 - exp(-2 t/T)), T = zeta_r/(2 k_t),   4 D_r t at first (2 D_r t for each sphere and axis)
TEST(Brownian, rotation_diffuses_with_D_r_and_a_twisting_spring_holds_its_share_of_kT) {
  DryingModel model = in_bulk();
  model.contact.sliding_limit_factor = model.contact.rolling_limit_factor = 0;
  model.contact.twisting_limit_factor = 1e9;
  const BondLaw law(model.contact, model.material, a, a);
  const int pairs = 1000;
  std::vector<Vector3> position;
  for (int p = 0; p < pairs; ++p) {
    position.emplace_back(1e-6 * p, 0, 0);
    position.emplace_back(1e-6 * p + 2 * a + law.equilibrium_gap(), 0, 0);
  }
  Agglomerate s = spheres(position);
  for (std::int32_t p = 0; p < pairs; ++p)
    s.state.contacts.push_back(make_bond(law, 2 * p, 2 * p + 1, position[2 * p + 1] - position[2 * p], a, a, 0));
  Brownian integrator(model, s, 4, {0.15, 3});
  const double relaxation = rotational_drag_coefficient(1e-3, a) / (2 * law.k_t);
  ASSERT_LT(integrator.long_step(), 0.1 * relaxation);  // so the first is free diffusion within 10 %
  for (const int blocks : {1, 4, 64}) {
    while (integrator.statistics().steps < blocks) integrator.step(1e9);
    double sum = 0;
    int count = 0;
    for (const Contact& bond : s.state.contacts)
      if (bond.born == 0) {  // there from the start, not made again
        sum += bond.twisting * bond.twisting;
        ++count;
      }
    ASSERT_GT(count, 150);
    const double expected = kT / law.k_t * -std::expm1(-2 * s.state.time / relaxation);
    // The bonds' state is half a step behind in its noise: 1/16 of the first block.
    EXPECT_NEAR(sum / count / expected, 1, 5 * std::sqrt(2.0 / count) + 0.07) << blocks;
  }
}

// One particle held at the surface of a droplet that does not shrink: the density of its radius is
// r^2 exp(-U_capillary(r)/kT).
TEST(Brownian, a_particle_at_the_surface_has_the_Boltzmann_distribution) {
  DryingModel model = diffusing();
  const double R = 30e-9;
  model.droplet = {R, 1e6, 1.75e-4};
  double weight = 0, mean = 0, square = 0;
  for (double r = 0.5e-12; r < R + a; r += 1e-12) {
    const double w = r * r * std::exp(-capillary_energy(1.75e-4, a, r - R) / kT);
    weight += w;
    mean += w * r;
    square += w * r * r;
  }
  mean /= weight;
  const double variance = square / weight - mean * mean;
  double sum = 0;
  const int runs = 200;
  for (int seed = 0; seed < runs; ++seed) {
    Agglomerate s = spheres({Vector3(5e-9, 3e-9, -4e-9)});
    Brownian integrator(model, s, static_cast<std::uint64_t>(seed), {});
    for (int k = 0; k < 60000; ++k) integrator.step(1e9);  // 3e-5 s, some ten times R^2/(pi^2 D)
    sum += s.state.position[0].norm();
  }
  EXPECT_NEAR(sum / runs, mean, 5 * std::sqrt(variance / runs));
}

// In a gradient of step size - particles near others take short steps - nothing may drift: pairs that start within the
// margin of each other move apart, and their centre of mass stays within its own diffusion.
TEST(Brownian, nothing_drifts_in_a_gradient_of_the_step) {
  const int pairs = 300;
  std::vector<Vector3> position;
  for (int p = 0; p < pairs; ++p) {
    position.emplace_back(1e-6 * p, 0, 0);
    position.emplace_back(1e-6 * p + 2.3 * a, 0, 0);
  }
  Agglomerate s = spheres(position);
  DryingModel model = in_bulk();
  model.material.surface_energy = 1e-7;  // hardly sticky
  Brownian integrator(model, s, 9, {0.15, 5});
  for (int k = 0; k < 300; ++k) integrator.step(1e9);
  EXPECT_GT(integrator.statistics().particle_steps, 0);
  EXPECT_LT(integrator.statistics().particle_steps, 300 * 2 * pairs);
  Vector3 drift = Vector3::Zero();
  for (int p = 0; p < 2 * pairs; ++p) drift += (s.state.position[p] - position[p]) / (2 * pairs);
  const double error = std::sqrt(2 * D() * s.state.time / (2 * pairs));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(drift[k], 0, 5 * error) << k;
}

TEST(Brownian, no_noise_is_drawn_on_dry_particles) {
  DryingModel model = diffusing();
  model.droplet = {30e-9, 1e6, 1.75e-4};
  Agglomerate s = spheres({Vector3(41e-9, 0, 0), Vector3(0, 0, 0)});
  Brownian integrator(model, s, 1, {});
  for (int k = 0; k < 50; ++k) integrator.step(1e9);
  EXPECT_EQ(s.state.position[0], Vector3(41e-9, 0, 0));
  EXPECT_NE(s.state.position[1], Vector3::Zero());

  model.dry.everything_acts = true;
  Agglomerate t = spheres({Vector3(41e-9, 0, 0)});
  Brownian noisy(model, t, 1, {});
  noisy.step(1e9);
  EXPECT_NE(t.state.position[0], Vector3(41e-9, 0, 0));
}

TEST(Brownian, same_seed_same_bits_and_other_seeds_other_paths) {
  const auto last = [](std::uint64_t seed) {
    DryingModel model = diffusing();
    model.droplet = {60e-9, 1e-5, 1.75e-4};
    Agglomerate s = start(10, 60e-9, 1);
    Brownian integrator(model, s, seed, {});
    for (int k = 0; k < 300; ++k) integrator.step(1e9);
    return s.state.position[3];
  };
  EXPECT_EQ(last(1), last(1));
  EXPECT_NE(last(1), last(2));
}

TEST(Inertial, without_thermal_energy_no_noise_is_drawn) {
  const auto last = [](double thermal_energy, std::uint64_t seed) {
    DryingModel model = diffusing();
    model.thermal_energy = thermal_energy;
    Agglomerate s = start(5, 60e-9, 1);
    Inertial integrator(model, s, 1e-12, seed);
    for (int k = 0; k < 20; ++k) integrator.step(1);
    return s.state.position[3];
  };
  EXPECT_EQ(last(0, 1), last(0, 2));
  EXPECT_EQ(last(0, 1), start(5, 60e-9, 1).state.position[3]) << "nor anything else, far from the surface";
  EXPECT_NE(last(kT, 1), last(kT, 2));
}

TEST(Inertial, velocity_of_a_free_particle_has_its_share_of_kT) {
  const int number = 100;
  Agglomerate s = lonely(number);
  const DryingModel model = in_bulk();
  const double m = s.particles.mass[0], inertia = m / drag_coefficient(1e-3, a), step = inertia / 200;
  Inertial integrator(model, s, step, 5);
  double sum = 0, spin = 0;
  int count = 0;
  for (int k = 0; k < 20000; ++k) {
    integrator.step(1e9);
    if (k < 2000 || k % 1000 != 0) continue;
    for (int p = 0; p < number; ++p) {
      sum += m * s.state.velocity[p].squaredNorm() / (3 * kT);
      spin += 0.4 * m * a * a * s.state.angular_velocity[p].squaredNorm() / (3 * kT);
      ++count;
    }
  }
  // The discrete kicks leave a bias of dt/(2 inertia time) = 0.25 %, below the sampling error.
  const double error = 5 * std::sqrt(2.0 / (3 * count));
  EXPECT_NEAR(sum / count, 1, error + 2.5e-3);
  EXPECT_NEAR(spin / count, 1, error + 1e-2);
}

TEST(Inertial, diffuses_as_far_as_6_D_t) {
  const int number = 300;
  Agglomerate s = lonely(number);
  const auto origin = s.state.position;
  const DryingModel model = in_bulk();
  const double inertia = s.particles.mass[0] / drag_coefficient(1e-3, a);
  Inertial integrator(model, s, inertia / 3, 5);
  for (int k = 0; k < 3000; ++k) integrator.step(1e9);
  double sum = 0;
  for (int p = 0; p < number; ++p) sum += (s.state.position[p] - origin[p]).squaredNorm();
  // Starting from rest, 6 D (t - 3/2 of the inertia time).
  const double expected = 6 * D() * (s.state.time - 1.5 * inertia);
  EXPECT_NEAR(sum / number / expected, 1, 5 * std::sqrt(2.0 / (3 * number)));
}

TEST(PairStatistics, of_the_papers_bond) {
  const double zeta = drag_coefficient(1e-3, a);
  const PairStatistics s = pair_statistics(Jkr(Material{}, a), kT, 2 * kT / zeta);
  EXPECT_NEAR(s.rupture / kT, 4.204, 1e-3);
  EXPECT_NEAR(s.lifetime, 2.203e-9, 1e-12);  // sums over a grid ten times as fine
  EXPECT_NEAR(second_virial_ratio(s.well, a), 0.072, 1e-3);
  EXPECT_NEAR(second_virial_ratio(s.stickiness, a), 0.581, 1e-3);
}

TEST(PairStatistics, a_wide_flat_well_lasts_as_long_as_free_diffusion) {
  // Hardly any energy: from h = 0 the gap diffuses to h_po; the well reaches to where the contact pushes back.
  Material weak;
  weak.surface_energy = 1e-5;
  const Jkr law(weak, a);
  const PairStatistics s = pair_statistics(law, kT, 1);
  EXPECT_LT(s.rupture, 1e-3 * kT);
  // MFPT = int_0^h_po (y + w) dy, w the width of the repulsive side: s.well = h_po + w.
  const double h = law.pull_off_gap, w = s.well - h;
  EXPECT_NEAR(s.lifetime, h * w + 0.5 * h * h, 2e-3 * s.lifetime);
}

TEST(PairStatistics, a_softened_bond_is_wider_and_holds_a_pair_as_tightly) {
  const Material stiff;
  const double before = pair_statistics(Jkr(stiff, a), kT, 1).stickiness;
  for (const double factor : {1.5, 2.0, 4.0}) {
    const Material soft = softened(stiff, a, kT, factor);
    EXPECT_NEAR(pair_statistics(Jkr(soft, a), kT, 1).stickiness, before, 1e-6 * before);
    EXPECT_NEAR(Jkr(soft, a).pull_off_gap, factor * Jkr(stiff, a).pull_off_gap, 1e-9 * factor * a);
    EXPECT_LT(Jkr(soft, a).tangent_stiffness(), Jkr(stiff, a).tangent_stiffness() / (factor * factor));
  }
  EXPECT_THROW(softened(stiff, a, kT, 0.5), std::invalid_argument);
}

// The pair in a closed sphere: bonded for the share of the time that the exact law gives. The odds are stickiness times
// S/Z, S and Z the surface and volume of pair configurations weighed with the energy at the surface of the droplet; S/Z
// = 7.428e7/m from 4 million random configurations.
class BondedFraction : public ::testing::TestWithParam<double> {};

TEST_P(BondedFraction, of_a_pair_in_a_closed_sphere_is_that_of_the_exact_law) {
  DryingModel model = diffusing();
  model.droplet = {30e-9, 1e6, 1.75e-4};
  const double odds = 7.428e7 * pair_statistics(Jkr(model.material, a), kT, 1).stickiness;
  model.material = softened(model.material, a, kT, GetParam());
  std::vector<double> means;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    Agglomerate s = start(2, 30e-9, seed);
    Brownian integrator(model, s, seed, {});
    const auto steps = static_cast<int>(6e-5 / integrator.long_step());
    double bonded = 0;
    for (int k = 0; k < steps; ++k) {
      integrator.step(1e9);
      bonded += static_cast<double>(s.state.contacts.size());
    }
    means.push_back(bonded / steps);
  }
  double mean = 0, square = 0;
  for (const double m : means) mean += m / 16, square += m * m / 16;
  const double error = std::sqrt((square - mean * mean) / 15);
  // 3 % for the finite step, see the manual.
  EXPECT_NEAR(mean, odds / (1 + odds), 4 * error + 0.03 * mean);
  EXPECT_LT(error, 0.1 * mean);
}

INSTANTIATE_TEST_SUITE_P(Softening, BondedFraction, ::testing::Values(1.0, 2.0, 4.0));

// The drag on what is dry only lets it come to rest. Paths part, so means over seeds are compared; their standard
// errors are about 1 % in d_c and 2 % in contacts. (At Pe = 300 ten times the drag leaves 13 % fewer contacts: see the
// manual.)
TEST(Brownian, the_drag_that_dry_particles_keep_does_not_change_the_granule) {
  constexpr int seeds = 4;
  struct Granule {
    double diameter = 0, contacts = 0;
  };
  const auto mean_granule = [](double drag_factor) {
    Granule mean;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      DryingModel model = diffusing();
      model.droplet = {120e-9, 120e-9 * 120e-9 / (60 * D()), 1.75e-4};
      model.dry.drag_factor = drag_factor;
      model.material = softened(model.material, a, kT, 2);
      Agglomerate s = start(40, 120e-9, seed);
      Brownian integrator(model, s, seed, {});
      while (s.state.time < model.droplet.lifetime) integrator.step(model.droplet.lifetime);
      const Morphology found = morphology(s.particles, s.state);
      EXPECT_EQ(found.fragments, 1) << "drag factor " << drag_factor << ", seed " << seed;
      mean.diameter += found.extent.diameter() / seeds;
      mean.contacts += static_cast<double>(found.contacts) / seeds;
    }
    return mean;
  };
  const Granule usual = mean_granule(1);
  for (const double factor : {0.1, 10.0}) {
    const Granule other = mean_granule(factor);
    EXPECT_NEAR(other.diameter, usual.diameter, 0.06 * usual.diameter) << "drag factor " << factor;
    EXPECT_NEAR(other.contacts, usual.contacts, 0.08 * usual.contacts) << "drag factor " << factor;
  }
}

}  // namespace
