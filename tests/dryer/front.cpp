// The second stage of drying: a dry crust hinders the vapour.
#include "dryer/front.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "dryer/implicit.hpp"
#include "dryer/run.hpp"
#include "tests/dryer/samples.hpp"

using namespace crumble;
using namespace crumble::dryer;
using namespace crumble::dryer::samples;

namespace {

TEST(CrustHindrance, is_that_of_two_resistances_in_series) {
  const double R = 0.7, R_p = 1.1, relative = 0.3;
  EXPECT_NEAR(crust_hindrance(relative, 1, R, R_p), (1 / R) / (1 / R_p + (1 / R - 1 / R_p) / relative), 1e-15);
  EXPECT_EQ(crust_hindrance(1, 1, R, R_p), 1);         // pores as open as the gas
  EXPECT_EQ(crust_hindrance(relative, 0, R, R_p), 1);  // no crust
  EXPECT_NEAR(crust_hindrance(relative, 1, 0, R_p), relative, 1e-15);
}

TEST(DryCrust, is_what_lies_beyond_the_surface) {
  const Agglomerate s = spheres({Vector3(50e-9, 0, 0), Vector3(0, 100e-9, 0), Vector3(0, 0, -200e-9)});
  const DryCrust crust = dry_crust(s.particles, s.state, 90e-9);
  const double near = 1.0 / 400, far = 1.0 / 1600;  // a^2/(4 r^2)
  EXPECT_NEAR(crust.covered, near + far, 1e-15);
  EXPECT_NEAR(crust.reach, (near * 110e-9 + far * 210e-9) / (near + far), 1e-20);
  EXPECT_EQ(dry_crust(s.particles, s.state, 300e-9).covered, 0);
}

// A particle that nothing moves is crust once the front has passed its centre at r. With c and R_p constant,
// k dt = -d(R^2) (1 + c (1/relative - 1)(1 - R/R_p)) integrates to
//   end/tau = 1 + c (1/relative - 1) (r^2/R0^2) (1 - (2/3) r/R_p).
// The rate stands for a step: an error of first order in the front's travel per step, 2e-4 of R0 here.
TEST(Front, takes_as_long_as_the_law_integrates_to) {
  DryingModel model = hollow();
  model.droplet.surface_tension = 0;
  model.crust_diffusivity = 0.01;
  const double a = 50e-9, r = 120e-9, R0 = model.droplet.initial_radius;
  Agglomerate s = spheres({Vector3(r, 0, 0)}, a);
  Implicit integrator(model, s, {.largest_displacement = 1e-3});
  while (s.state.time < integrator.front().end()) integrator.step(integrator.front().end());
  const double c = a * a / (4 * r * r);
  const double expected = 1 + c * 99 * r * r / (R0 * R0) * (1 - 2.0 / 3.0 * r / (r + a));
  EXPECT_GT(expected, 1.5);
  EXPECT_NEAR(s.state.time / model.droplet.lifetime, expected, 2e-3);
  EXPECT_EQ(integrator.front().radius(s.state.time), 0);
}

DryingScene scene_of(double relative, const std::string& more = "") {
  return drying_scene(Scene::parse(
      "[particle]\nradius = 10e-9\nnumber = 30\n" + more + "[droplet]\nradius = 137e-9\nlifetime = 1e-5\n[crust]\n" +
          fmt::format("relative_diffusivity = {}\n", relative) + "[integrator]\nlargest_displacement = 0.05\n",
      "drying.toml", drying_parameters()));
}

TEST(SecondStage, lasts_longer_but_within_what_the_law_allows_and_leaves_a_granule) {
  for (const char* noise : {"", "brownian_motion = true\n"}) {
    const DryingScene scene = scene_of(0.2, noise);
    DryingRun run(scene, 1);
    double before = run.droplet_radius();
    while (!run.finished()) {
      run.step();
      EXPECT_LE(run.droplet_radius(), before);
      before = run.droplet_radius();
    }
    EXPECT_EQ(before, 0);
    EXPECT_GT(run.state().state.time, 1.01e-5);
    EXPECT_LT(run.state().state.time, 5e-5);
    EXPECT_GT(run.state().state.contacts.size(), 20u);
  }
}

TEST(SecondStage, of_a_crust_as_open_as_the_gas_is_equation_7) {
  const DryingScene scene = scene_of(1);
  DryingRun run(scene, 1);
  while (!run.finished()) {
    run.step();
    EXPECT_EQ(run.droplet_radius(), scene.model.droplet.radius(run.state().state.time));
  }
  EXPECT_EQ(run.state().state.time, 1e-5);
}

}  // namespace
