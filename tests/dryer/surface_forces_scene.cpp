// [surface_forces] of a drying scene.
#include <gtest/gtest.h>

#include "common/io/surface_forces_parameters.hpp"
#include "dryer/brownian.hpp"
#include "dryer/regime.hpp"
#include "dryer/run.hpp"
#include "dryer/stabilised.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

const std::string silica = "hamaker = 4.6e-21\nsurface_potential = 0.03\nionic_strength = 1\n";

DryingScene scene(const std::string& table, const std::string& more = "", const char* brownian = "true") {
  const std::string text = std::string("[particle]\nradius = 10e-9\nnumber = 20\nbrownian_motion = ") + brownian +
                           "\n[droplet]\nradius = 120e-9\nlifetime = 2e-6\n" +
                           (table.empty() ? "" : "[surface_forces]\n" + table) + more;
  return drying_scene(Scene::parse(text, "s.toml", drying_parameters()));
}

std::string refusal(const std::string& table, const std::string& more = "", const char* brownian = "true") {
  try {
    scene(table, more, brownian);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// Polystyrene of 100 nm.
DryingScene polymer(const std::string& more, double ionic_strength = 10) {
  return drying_scene(Scene::parse(
      "[particle]\nradius = 100e-9\nnumber = 20\nbrownian_motion = true\n[droplet]\nradius = 1.2e-6\nlifetime = 1e-3\n"
      "[surface_forces]\nhamaker = 9.5e-21\nsurface_potential = 0.04\nionic_strength = " +
          std::to_string(ionic_strength) + "\n" + more,
      "p.toml", drying_parameters()));
}

void expect_says(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
}

TEST(SurfaceForcesScene, without_a_table_there_are_none) {
  EXPECT_FALSE(scene("").model.surface_forces);
  EXPECT_GT(scene("").softening, 1);
}

TEST(SurfaceForcesScene, values_are_in_SI_and_salt_may_be_given_in_mol_per_litre) {
  const SurfaceForces f = *scene(silica + "retardation_wavelength = 1e-7\ncut_off = 20e-9\n").model.surface_forces;
  EXPECT_EQ(f.hamaker, 4.6e-21);
  EXPECT_EQ(f.surface_potential, 0.03);
  EXPECT_EQ(f.electrolyte.ionic_strength, 1);
  EXPECT_EQ(f.retardation_wavelength, 1e-7);
  EXPECT_EQ(f.range, 20e-9);
  EXPECT_NEAR(f.electrolyte.thermal_energy, 1.380649e-23 * 300, 1e-35);
  EXPECT_EQ(scene("hamaker = 4.6e-21\nsurface_charge = 0.002\nionic_strength_molar = 0.01\n")
                .model.surface_forces->electrolyte.ionic_strength,
            10);
  EXPECT_EQ(scene(silica).softening, 1);
}

TEST(SurfaceForcesScene, another_unit_is_refused_with_the_number_that_was_meant) {
  expect_says(refusal("hamaker = 4.6e-21\nsurface_potential = 30\nionic_strength = 1\n"),
              {"s.toml:10: surface_forces.surface_potential = 30.0 V", "if mV were meant, write 0.03"});
  expect_says(refusal("hamaker = 4.6\nsurface_potential = 0.03\nionic_strength = 1\n"),
              {"surface_forces.hamaker = 4.6 J", "zJ", "write 4.6e-21"});
  expect_says(refusal("hamaker = 4.6e-21\nsurface_potential = 0.03\nionic_strength = 1e-4\n"),
              {"surface_forces.ionic_strength", "if mol/l were meant, write 0.1"});
  expect_says(refusal(silica + "retardation_wavelength = 100\n"), {"if nm were meant, write 1e-07"});
  expect_says(refusal(silica + "cut_off = 20\n"), {"if nm were meant, write 2e-08"});
}

TEST(SurfaceForcesScene, what_says_too_little_or_contradicts_itself_names_its_keys) {
  expect_says(refusal("surface_potential = 0.03\nionic_strength = 1\n"),
              {"surface_forces.surface_potential", "surface_forces.hamaker"});
  expect_says(refusal("hamaker = 4.6e-21\n"), {"surface_forces.surface_potential in V", "surface_charge"});
  expect_says(refusal("hamaker = 4.6e-21\nsurface_potential = 0.03\n"), {"needs surface_forces.ionic_strength"});
  expect_says(refusal(silica + "surface_charge = 0.01\n"), {"twice"});
  expect_says(refusal("hamaker = 4.6e-21\nsurface_potential = 0.03\nionic_strength = 6000\n"), {"solubility"});
  expect_says(refusal("hamaker = 0\nsurface_potential = 0\n"), {"remove the table"});
  expect_says(refusal(silica + "sets_surface_energy = true\n", "[material]\nsurface_energy = 5e-3\n"),
              {"material.surface_energy", "surface_forces.sets_surface_energy"});
  expect_says(refusal(silica, "[integrator]\nsoftening = 2\n"), {"integrator.softening"});
}

TEST(SurfaceForcesScene, laws_are_refused_where_they_do_not_hold) {
  expect_says(refusal("hamaker = 4.6e-21\nsurface_potential = 0.3\nionic_strength = 1\n"),
              {"surface_forces.surface_potential", "holds up to 0.207 V"});
  expect_says(refusal("hamaker = 4.6e-21\nsurface_potential = 0.1\nionic_strength = 2e-3\n"),
              {"kappa a = 0.046", "surface_forces.ionic_strength = 0.009"});
  // An attraction that the contact law cuts off where the surfaces are far apart.
  expect_says(refusal(silica, "[material]\nsurface_energy = 2e-5\n"),
              {"surface_forces.hamaker", "material.surface_energy = 2e-05", "sets_surface_energy = true"});
}

TEST(SurfaceForcesScene, every_integrator_but_the_implicit_one_takes_them) {
  const auto method = [](const char* name) { return std::string("[integrator]\nmethod = \"") + name + "\"\n"; };
  expect_says(refusal(silica, method("implicit"), "false"),
              {"integrator.method", "surface_forces.hamaker", "\"overdamped\"", "\"inertial\""});
  expect_says(refusal(silica, "[contact]\nlaw = \"cundall-strack\"\n", "false"),
              {"integrator.method", "cundall-strack", "surface_forces.hamaker", "\"inertial\""});
  for (const char* name : {"overdamped", "stabilised", "inertial"})
    EXPECT_EQ(refusal(silica, method(name), "false"), "accepted") << name;
  EXPECT_TRUE(scene(silica, "", "false").is(IntegratorKind::stabilised));
  // With noise, stabilised steps where no bond breaks thermally: at 100 nm, not at 10 nm.
  expect_says(refusal(silica, method("stabilised")), {"integrator.method", "bonds that thermal motion breaks"});
  EXPECT_TRUE(scene(silica).is(IntegratorKind::brownian));
  EXPECT_TRUE(polymer("").is(IntegratorKind::stabilised));
  EXPECT_TRUE(polymer(method("two-rate")).is(IntegratorKind::brownian));
}

TEST(SurfaceForcesScene, noise_stands_for_less_where_salt_makes_the_barrier_narrow) {
  // 0.96 nm at 100 mol/m3 and 9.6 nm at 1: the usual 0.5 nm are a quarter of 2 nm.
  EXPECT_NEAR(polymer("", 100).stabilised.brownian_displacement, 0.25 * 0.962e-9 / 100e-9, 2e-5);
  EXPECT_EQ(polymer("", 1).stabilised.brownian_displacement, 0.005);
  EXPECT_EQ(polymer("[integrator]\nbrownian_displacement = 0.01\n", 100).stabilised.brownian_displacement, 0.01);
}

// The forecast counts them: by itself a stiff gap, more evaluations for the double layers, nobody asleep.
TEST(SurfaceForcesScene, forecast_of_the_work_grows_with_surface_forces) {
  const StepTimes times{1e-6, 1e-7, 60};
  const auto work = [&](const DryingScene& s, bool with) {
    DryingModel model = s.model;
    model.droplet.lifetime *= 100;  // at a high Peclet number the front has reached most of them anyhow
    if (!with) model.surface_forces.reset();
    if (s.is(IntegratorKind::stabilised)) return Stabilised::expected_work(model, s.radius, s.stabilised, times);
    return Brownian::expected_work(model, s.radius, {{model, 6, 1e9}}, 0.15, times);
  };
  for (const DryingScene& s : {scene(silica), polymer("", 1), polymer("", 1000), scene(silica, "", "false")})
    EXPECT_GT(work(s, true).seconds, 1.05 * work(s, false).seconds)
        << s.model.surface_forces->electrolyte.ionic_strength;
}

TEST(SurfaceForcesScene, surface_energy_may_follow_from_the_Hamaker_constant) {
  const DryingScene s = scene("hamaker = 9.85e-21\nsurface_potential = 0\nsets_surface_energy = true\n");
  EXPECT_NEAR(s.model.material.surface_energy, 4.8e-3, 3e-6);
}

TEST(SurfaceForcesScene, the_forecast_says_barrier_and_stability_at_the_start_and_when_packed) {
  const DryingScene s = scene(silica, "[fluid]\ntemperature = 298.15\n");
  std::string text;
  for (const std::string& line : describe(s)) text += line + "\n";
  expect_says(
      text, {"kappa a = 1.04", "barrier 7.48 kT at 0.797 nm", "W = 152 (free draining", "when the solids are packed"});
  const PairOutlook o = outlook(*s.model.surface_forces, s.model.contact, s.model.material, 10e-9, 100);
  EXPECT_NEAR(*o.barrier, 4.10, 0.01);
  EXPECT_NEAR(std::exp(o.log_W_lubricated), 12.8, 0.1);
}

TEST(SurfaceForcesScene, a_droplet_dries_into_a_granule_and_its_salt_is_concentrated) {
  const DryingScene s = scene(silica);
  DryingRun run(s, 1);
  double last = 0;
  while (!run.finished()) {
    run.step();
    const double now = *run.integrator().ionic_strength();
    EXPECT_GE(now, 0.99 * last);  // the liquid shrinks; particles that leave it give volume back
    last = std::max(last, now);
  }
  EXPECT_EQ(last, 5400);
  EXPECT_GT(run.state().state.contacts.size(), 0u);
}

}  // namespace
