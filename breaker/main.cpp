// Breaks one agglomerate in a flow that grows: scene and agglomerate in, breakup file out.
#include <omp.h>

#include <filesystem>

#include "breaker/breaking.hpp"
#include "breaker/expected_cost.hpp"
#include "breaker/result.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/flow/history_parameters.hpp"
#include "common/io/command_line.hpp"
#include "common/io/earlier_result.hpp"
#include "common/io/granule.hpp"
#include "common/io/machine.hpp"
#include "common/io/output_lock.hpp"
#include "common/io/program.hpp"
#include "common/io/sha256.hpp"
#include "common/io/surface_forces_parameters.hpp"

using namespace crumble;
using namespace crumble::breaker;

namespace {

ProgramDescription description() {
  return {"breaker",
          "Carries a flexible agglomerate through a flow of growing strength until it breaks: it turns into the flow, "
          "bends, its contacts slip, roll, break and form anew.",
          {{"AGGLOMERATE.h5", "the agglomerate: of the dryer, an import, or an earlier breakup"}},
          {{"breaker breakup.toml hollow.h5 -o breakup.h5 --report breakup.json", "one breakup"},
           {"breaker breakup.toml hollow.h5 -o quick.h5 --set error.estimate=false --set integrator.tolerance=0.02",
            "half the time, and no error"},
           {"breaker breakup.toml hollow.h5 -o breakup.h5 --at \"10 W/kg\"", "does it hold in this turbulence?"},
           {"breaker breakup.toml breakup.h5 -o more.h5 --set particle.contacts=keep", "a fragment goes on"}},
          version_text("breaker"),
          breaker_parameters(),
          true,
          true};
}

// A breakup belongs to the agglomerate and the history as they were.
CheckpointOwner checkpoint_owner(const Scene& text, const Provenance& provenance) {
  CheckpointOwner owner{"breaker", provenance.version, text.resolved() + "\n# of " + provenance.parent_sha256};
  for (const ReadFile& file : history_files(text)) owner.scene += "\n# and " + sha256_of_file(file.name);
  return owner;
}

int break_up(int argc, const char* const* argv) {
  const CommandLine line = parse_command_line(description(), argc, argv);
  if (line.answer) {
    deliver(*line.answer);
    return 0;
  }
  Scene text = Scene::read(line.scene, breaker_parameters(), line.overrides);
  const std::string input = line.inputs.front();
  Agglomerate agglomerate = read_agglomerate(input);
  const Parent parent{input, read_info(input).properties, mean_radius(agglomerate.particles)};
  inherit(text, parent);
  BreakerScene scene = breaker_scene(text);
  const std::optional<ServiceLoad> at = service_load_at(line.at, scene.liquid);
  if (at && scene.protocol.has_history())
    throw InputError("--at asks whether a strength suffices; along flow.history the run itself says whether it breaks");
  const int threads = line.threads > 0 ? line.threads : default_threads(omp_get_max_threads(), this_machine());
  omp_set_num_threads(1);  // beside each other the run and its companion use two cores
  const Provenance provenance = make_provenance("breaker", {argv, argv + argc}, 0, "none", input);
  Report report("breaker", provenance.version, line.scene, std::nullopt);
  ProgressPrinter progress(stderr, line.check ? line.scene : std::filesystem::path(line.output).stem().string(),
                           line.quiet);
  progress.say(granule_line(text, parent));
  if (const std::string warning = material_warning(text); !warning.empty()) progress.say(warning);
  report_inputs(report, text, parent);
  if (const auto& forces = scene.model.surface_forces) {
    const double a = scene.radius.value_or(parent.radius);
    check_surface_forces(text, *forces, scene.model.material, a, a);
    const PairOutlook look =
        outlook(*forces, scene.model.contact, scene.model.material, a, forces->electrolyte.ionic_strength);
    for (const std::string& fact : describe(look, "in this liquid")) progress.say(fact);
    report_outlook(report, "surface_forces", look);
  }
  const Start start = make_start(std::move(agglomerate), input, scene);
  adapt(scene, start.rigid_strength);
  for (const std::string& fact : describe(scene, start)) progress.say(fact);
  ExpectedCost cost;
  if (!scene.model.gradient.isZero()) {
    cost = expected_cost(scene, start);
    if (cost.step_seconds > 0) progress.say(expected_cost_text(cost));
  }
  if (line.check) {
    const BreakupRun builds(scene, start.agglomerate, 1);
    return 0;
  }

  const OwnedOutputs owned(line.written, history_files(text));
  if (!line.overwrite) require_no_other_result(line.output, provenance, text.resolved());
  const OutputCheckpoint checkpoint(line.output, checkpoint_owner(text, provenance));
  if (line.restart) checkpoint.require();
  if (checkpoint.found()) progress.say("resuming from " + checkpoint.path());
  if (const std::string left = checkpoint.leftovers(); !left.empty()) progress.say(left);
  report.add_earlier(checkpoint.used());
  Breaking breaking({line, text, scene, parent, start, provenance, cost, progress, threads > 1}, checkpoint);
  breaking.finish();
  checkpoint.remove();
  breaking.forget();
  fill_report(report, scene, start, breaking.run(), breaking.companion());
  std::string answer = result_text(breaking.run(), scene, breaking.companion());
  if (at)
    answer += report_service(report, *at, granule_strength(breaking.run(), scene, text, start, breaking.companion()));
  deliver(answer, [&] { report.write(line.report); });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  wait_without_spinning(argv);
  return run_program("breaker", [&] { return break_up(argc, argv); });
}
