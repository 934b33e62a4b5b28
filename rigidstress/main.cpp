// Loads in a rigid agglomerate: scene and agglomerate in, stress file out.
#include <fmt/core.h>
#include <omp.h>

#include <filesystem>

#include "common/agglomerate/morphology.hpp"
#include "common/io/command_line.hpp"
#include "common/io/earlier_result.hpp"
#include "common/io/granule.hpp"
#include "common/io/machine.hpp"
#include "common/io/output_lock.hpp"
#include "common/io/program.hpp"
#include "common/io/provenance.hpp"
#include "common/io/sha256.hpp"
#include "common/io/state_keeper.hpp"
#include "common/io/surface_forces_parameters.hpp"
#include "common/numerics/noise.hpp"
#include "rigidstress/result.hpp"
#include "rigidstress/stress_file.hpp"

using namespace crumble;
using namespace crumble::rigidstress;

namespace {

ProgramDescription description() {
  return {"rigidstress",
          "Where the load sits in an agglomerate that moves as a rigid body in a flow, and at which flow stress its "
          "weakest contact gives way.",
          {{"AGGLOMERATE.h5", "the agglomerate; a stress file of the same scene lends its response"}},
          {{"rigidstress stress-elongation.toml hollow.h5 -o stress.h5 --report stress.json", "one agglomerate"},
           {"rigidstress stress-elongation.toml hollow.h5 -o fast.h5 --set hydrodynamics.method=fts",
            "far-field hydrodynamics, a tenth of a second"},
           {"rigidstress stress-elongation.toml stress.h5 -o more.h5 --set flow.uniaxial=true",
            "another flow, nothing factorised again"},
           {"rigidstress stress.toml hollow.h5 -o stress.h5 --at \"1e4 1/s\"", "does it hold at this shear rate?"}},
          version_text("rigidstress"),
          stress_parameters(),
          true,
          true};
}

// What is done belongs to the agglomerate and the history as they were.
CheckpointOwner checkpoint_owner(const Scene& text, const Provenance& provenance) {
  CheckpointOwner owner{"rigidstress", provenance.version,
                        fmt::format("{}\n# of {}", text.resolved(), provenance.parent_sha256)};
  for (const ReadFile& file : history_files(text)) owner.scene += "\n# and " + sha256_of_file(file.name);
  return owner;
}

DoneParts saved_parts(const OutputCheckpoint& checkpoint) {
  if (!checkpoint.found()) return {};
  return checkpoint.restored([](SavedFields& f) {
    SavedState saved;
    f.part("done", saved);
    f.require_all_read();
    return DoneParts(std::move(saved));
  });
}

int load(int argc, const char* const* argv) {
  const CommandLine line = parse_command_line(description(), argc, argv);
  if (line.answer) {
    deliver(*line.answer);
    return 0;
  }
  Scene text = Scene::read(line.scene, stress_parameters(), line.overrides);
  const std::string input = line.inputs.front();
  const Agglomerate agglomerate = read_agglomerate(input);
  const Parent parent{input, read_info(input).properties, mean_radius(agglomerate.particles)};
  inherit(text, parent);
  const StressScene scene = stress_scene(text);
  const std::optional<ServiceLoad> at = service_load_at(line.at, scene.liquid);
  omp_set_num_threads(line.threads > 0 ? line.threads : default_threads(omp_get_max_threads(), this_machine()));
  std::optional<OwnedOutputs> owned;
  if (!line.check) owned.emplace(line.written, history_files(text));
  const Provenance provenance = make_provenance("rigidstress", {argv, argv + argc}, scene.seed, rng_name, input);
  Report report("rigidstress", provenance.version, line.scene, static_cast<std::int64_t>(scene.seed));
  if (!line.check && !line.overwrite) require_no_other_result(line.output, provenance, text.resolved());
  ProgressPrinter progress(stderr, std::filesystem::path(input).stem().string(), line.quiet);
  const Say say = [&](const std::string& message) { progress.say(message); };

  say(granule_line(text, parent));
  if (const std::string warning = material_warning(text); !warning.empty()) say(warning);
  report_inputs(report, text, parent);
  if (scene.surface_forces) {
    const double a = scene.radius.value_or(parent.radius);
    check_surface_forces(text, *scene.surface_forces, scene.material, a, a);
    const PairOutlook look =
        outlook(*scene.surface_forces, {}, scene.material, a, scene.surface_forces->electrolyte.ionic_strength);
    for (const std::string& fact : describe(look, "in this liquid")) say(fact);
    say("of the surface forces the pull-off force in this liquid counts here, and nothing else: contacts that are not "
        "broken do not feel the others");
    report_outlook(report, "surface_forces", look);
  }
  std::optional<Analysis> analysis = restore(input, text, scene);
  std::optional<Prepared> prepared;
  if (analysis) {
    say("the response of " + input + " is that of this scene: nothing is factorised");
  } else {
    prepared =
        prepare(agglomerate, input, scene.radius, scene.material, scene.largest_gap, scene.pieces == Pieces::largest);
    for (const std::string& fact : describe(*prepared)) say(fact);
  }
  if (line.check) return 0;

  const OutputCheckpoint checkpoint(line.output, checkpoint_owner(text, provenance));
  if (line.restart) checkpoint.require();
  if (checkpoint.found()) say("resuming from " + checkpoint.path());
  if (const std::string left = checkpoint.leftovers(); !left.empty()) say(left);
  report.add_earlier(checkpoint.used());
  DoneParts done = saved_parts(checkpoint);
  StateKeeper keeper(
      checkpoint, scene.checkpoint_interval, [&](SavedFields& f) { done.fields(f); }, nullptr, say);
  std::string part;
  done.begins = [&](const std::string& name) { progress.in_hand(part = name); };
  done.done = [&] { keeper.between_steps([&] { return "after " + part; }); };
  keeper.guard([&] {
    if (!analysis) analysis = analyse(std::move(*prepared), input, scene, say, done);
    run_flows(*analysis, scene, done);
    progress.in_hand("writing the file");
    AgglomerateWriter writer(line.output, analysis->prepared.particles,
                             {"rigidstress", provenance, text.given(), text.resolved(), "none"});
    write_stress(writer, *analysis, scene);
    write_properties(writer, properties_of(text, parent.properties));
    writer.finish("relaxed");
  });
  checkpoint.remove();
  fill_report(report, *analysis, scene);
  std::string answer = result_text(*analysis, scene);
  if (at) answer += report_service(report, *at, granule_strength(*analysis, scene, text));
  deliver(answer, [&] { report.write(line.report); });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  wait_without_spinning(argv);
  return run_program("rigidstress", [&] { return load(argc, argv); });
}
