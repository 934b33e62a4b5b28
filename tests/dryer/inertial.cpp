#include "dryer/inertial.hpp"

#include <gtest/gtest.h>

#include "common/agglomerate/bond.hpp"
#include "dryer/drag.hpp"
#include "tests/dryer/samples.hpp"

using namespace crumble;
using namespace crumble::dryer;
using namespace crumble::dryer::samples;

namespace {

constexpr double a = 10e-9;

// A bonded pair deep in a droplet that lasts for ever, set moving.
Agglomerate moving_pair(const DryingModel& model) {
  const BondLaw law(model.contact, model.material, a, a);
  Agglomerate s = spheres({Vector3::Zero(), Vector3(2 * a + law.equilibrium_gap(), 0, 0)});
  s.state.contacts = {make_bond(law, 0, 1, s.state.position[1], a, a, 0)};
  s.state.velocity = {Vector3(0.01, 0.02, 0), Vector3(-0.02, 0.01, 0.01)};
  s.state.angular_velocity = {Vector3(1e5, -2e5, 3e5), Vector3(-1e5, 1e5, 2e5)};
  return s;
}

DryingModel still(double viscosity) {
  DryingModel model = hollow();
  model.droplet = {1e-3, 1, 0};
  model.viscosity = viscosity;
  model.contact.sliding_limit_factor = model.contact.twisting_limit_factor = model.contact.rolling_limit_factor = 1e6;
  return model;
}

Agglomerate run(const DryingModel& model, Agglomerate state, double end, double step) {
  Inertial integrator(model, state, step);
  const auto steps = std::llround(end / step);
  for (int k = 0; k < steps; ++k) integrator.step(1);
  return state;
}

TEST(Inertial, converges_with_second_order_on_a_bonded_pair) {
  const DryingModel model = still(1e-3);
  const double end = 2e-10;
  const auto reference = run(model, moving_pair(model), end, end / 12800).state;
  std::vector<double> error;
  for (const int steps : {50, 100, 200, 400}) {
    const auto result = run(model, moving_pair(model), end, end / steps).state;
    error.push_back((result.position[1] - reference.position[1]).norm() +
                    a * a * (result.angular_velocity[0] - reference.angular_velocity[0]).norm() * 1e-6);
  }
  for (std::size_t k = 1; k < error.size(); ++k) EXPECT_NEAR(std::log2(error[k - 1] / error[k]), 2, 0.2) << k;
}

TEST(Inertial, velocity_and_rotation_relax_in_the_liquid_as_they_must) {
  const DryingModel model = still(1e-3);
  Agglomerate s = spheres({Vector3(5e-9, 0, 0)});
  s.state.velocity = {Vector3(0, 0.1, 0)};
  s.state.angular_velocity = {Vector3(0, 0, 1e6)};
  // The front touches the particle, so it is integrated; sigma = 0, so nothing but drag acts.
  DryingModel touching = model;
  touching.droplet.initial_radius = 14e-9;
  const double m = s.particles.mass[0], t = 5e-11;
  s = run(touching, s, t, 1e-12);
  EXPECT_NEAR(s.state.velocity[0].y() / (0.1 * std::exp(-drag_coefficient(1e-3, a) * t / m)), 1, 1e-10);
  EXPECT_NEAR(
      s.state.angular_velocity[0].z() / (1e6 * std::exp(-rotational_drag_coefficient(1e-3, a) * t / (0.4 * m * a * a))),
      1, 1e-10);
}

TEST(Inertial, contacts_create_no_momentum) {
  const DryingModel model = still(1e-12);  // almost no drag
  const Agglomerate s = moving_pair(model);
  const double m = s.particles.mass[0], I = 0.4 * m * a * a;
  const auto linear = [&](const Frame& f) -> Vector3 { return m * (f.velocity[0] + f.velocity[1]); };
  const auto angular = [&](const Frame& f) -> Vector3 {
    return m * (f.position[0].cross(f.velocity[0]) + f.position[1].cross(f.velocity[1])) +
           I * (f.angular_velocity[0] + f.angular_velocity[1]);
  };
  const auto end = run(model, s, 1e-9, 1e-12).state;
  EXPECT_LT((linear(end) - linear(s.state)).norm(), 5e-8 * linear(s.state).norm());     // drag: zeta t/m = 3.5e-8
  EXPECT_LT((angular(end) - angular(s.state)).norm(), 1e-5 * angular(s.state).norm());  // second order in the step
}

TEST(Inertial, does_not_integrate_what_neither_front_nor_bond_has_reached) {
  Agglomerate s = spheres({Vector3::Zero(), Vector3(150e-9, 0, 0)});
  const DryingModel model = hollow();
  Inertial integrator(model, s, Inertial::recommended_step(model, s.particles));
  for (int k = 0; k < 100; ++k) integrator.step(1);
  EXPECT_EQ(integrator.statistics().particle_steps, 0);
  EXPECT_EQ(s.state.position[1], Vector3(150e-9, 0, 0));
}

TEST(Inertial, reports_a_number_that_is_not_finite_where_it_is_born) {
  const DryingModel model = still(1e-3);
  Agglomerate s = moving_pair(model);
  s.state.velocity[1].x() = std::nan("");
  Inertial integrator(model, s, Inertial::recommended_step(model, s.particles));
  try {
    integrator.step(1);
    FAIL() << "no error";
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("bond 0-1"), std::string::npos) << error.what();
  }
}

}  // namespace
