#include "dryer/conditions_command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "common/io/errors.hpp"
#include "common/io/output_lock.hpp"
#include "common/io/program.hpp"
#include "common/io/provenance.hpp"
#include "common/io/report.hpp"
#include "dryer/conditions.hpp"
#include "dryer/scene.hpp"

namespace crumble::dryer {

namespace {

struct Raw {
  std::string scene, output, report;
  std::vector<std::string> set;
  double particles = 1000;
};

InputError misuse(const std::string& wrong) {
  return InputError(
      fmt::format("dryer conditions: {}\nusage: dryer conditions [SCENE.toml] [--set KEY=VALUE ...] [-o FILE.csv]\n"
                  "dryer conditions --help explains",
                  wrong));
}

Scene scene_of(const Raw& raw) {
  std::vector<Override> overrides;
  for (const std::string& one : raw.set) overrides.push_back(parse_override(one));
  Scene scene = raw.scene.empty() ? Scene::parse("", "no scene", drying_parameters(), overrides)
                                  : Scene::read(raw.scene, drying_parameters(), overrides);
  inherit_from_gas(scene);
  return scene;
}

OwnedOutputs own_outputs(const Raw& raw, const Scene& scene) {
  std::vector<WrittenFile> written;
  if (!raw.output.empty()) written.push_back({.what = "-o", .name = raw.output, .is_text = true});
  if (!raw.report.empty()) written.push_back({.what = "--report", .name = raw.report, .is_text = true});
  std::vector<ReadFile> read = gas_files(scene);
  if (!raw.scene.empty()) read.push_back({"the scene", raw.scene});
  return {written, read};
}

}  // namespace

int conditions_command(int argc, const char* const* argv) {
  CLI::App app(
      "What a gas makes of a droplet, before anything is dried: wet bulb, lifetime, evaporation constant, Peclet "
      "number "
      "of the particles, the granule to expect, and the smaller droplet that stands for it.",
      "dryer conditions");
  Raw raw;
  app.add_option("scene", raw.scene, "a scene with [gas]; --set can say all, too")->type_name("SCENE.toml");
  app.add_option("--set", raw.set, "a key of the scene, as --set gas.temperature=423")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--particles", raw.particles, "of the smaller droplet that stands for this one, 1000 by default")
      ->type_name("N")
      ->check(CLI::Range(1.0, 1e9));
  app.add_option("-o,--output", raw.output, "radius, temperature, k and Pe in time")->type_name("FILE.csv");
  app.add_option("--report", raw.report, "all numbers as JSON")->type_name("FILE.json");
  app.footer(
      "Example:\n  dryer conditions --set gas.temperature=423 --set gas.vapour_mass_fraction=0.01 --set "
      "droplet.diameter=50e-6 --set particle.radius=10e-9 --set particle.solids_fraction=0.05");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    deliver(app.help());
    return 0;
  } catch (const CLI::ParseError& error) {
    throw misuse(error.what());
  }
  const Scene scene = scene_of(raw);
  const OwnedOutputs owned = own_outputs(raw, scene);
  Report report("dryer conditions", make_provenance("dryer", {argv, argv + argc}, 0, "none").version, raw.scene, {});
  const Conditions found = conditions(scene, raw.particles);
  if (!raw.output.empty()) write_text_file(raw.output, conditions_csv(found));
  fill_report(report, found);
  report.left_out = {"solids in the droplet: its heat capacity and evaporation are those of water",
                     "solutes: the vapour pressure is that of pure water", "radiation of heat",
                     "the crust: what it holds back (crust.relative_diffusivity) is found while drying"};
  deliver(conditions_table(found), [&] { report.write(raw.report); });
  return 0;
}

}  // namespace crumble::dryer
