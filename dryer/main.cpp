// Dries one droplet of colloid: scene in, agglomerate file out.
#include <malloc.h>
#include <omp.h>

#include <filesystem>
#include <string_view>

#include "common/io/command_line.hpp"
#include "common/io/earlier_result.hpp"
#include "common/io/granule.hpp"
#include "common/io/machine.hpp"
#include "common/io/output_lock.hpp"
#include "common/io/program.hpp"
#include "common/io/provenance.hpp"
#include "common/numerics/noise.hpp"
#include "dryer/conditions_command.hpp"
#include "dryer/continuum_command.hpp"
#include "dryer/drying.hpp"
#include "dryer/expected_cost.hpp"
#include "dryer/outcome.hpp"
#include "dryer/regime.hpp"
#include "dryer/result.hpp"
#include "dryer/scene.hpp"
#include "dryer/stand_in.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

ProgramDescription description() {
  return {"dryer",
          "Dries a droplet of colloid into a granule: the shrinking surface drags the particles along, they bond where "
          "they "
          "touch, and what is left when the liquid is gone is the agglomerate.",
          {},
          {{"dryer hollow.toml -o hollow.h5 --seed 3 --report hollow.json", "dry one granule"},
           {"dryer hollow.toml -o soft.h5 --set contact.rolling_limit_factor=0",
            "the same droplet without rolling resistance"},
           {"dryer spray.toml --fit-to \"1 h\" > small.toml",
            "the scene of a smaller droplet that stands for one of too many particles"},
           {"dryer hollow.toml --check", "say what the scene means, run nothing"},
           {"dryer continuum --peclet 1 --theta 0.2,0.4 -o continuum.csv",
            "concentration of point particles; dryer continuum --help explains"},
           {"dryer conditions spray.toml",
            "what a gas makes of a droplet, before anything is dried; dryer conditions --help explains"}},
          version_text("dryer"),
          drying_parameters(),
          true,
          false,
          true};
}

// What is saved belongs to the history of the gas as it was.
CheckpointOwner checkpoint_owner(const Scene& text, const Provenance& provenance) {
  CheckpointOwner owner{"dryer", provenance.version, text.resolved()};
  for (const ReadFile& file : gas_files(text)) owner.scene += "\n# and " + sha256_of_file(file.name);
  return owner;
}

int dry(int argc, const char* const* argv) {
  const CommandLine line = parse_command_line(description(), argc, argv);
  if (line.answer) {
    deliver(*line.answer);
    return 0;
  }
  const Machine machine = this_machine();
  omp_set_num_threads(line.threads > 0 ? line.threads : default_threads(omp_get_max_threads(), machine));
  Scene text = Scene::read(line.scene, drying_parameters(), line.overrides);
  inherit_from_gas(text);
  if (!line.fit_to.empty()) {
    deliver(stand_in(text, fit_to(line.fit_to), machine));
    return 0;
  }
  const DryingScene scene = drying_scene(text, machine);
  const Provenance provenance = make_provenance("dryer", {argv, argv + argc}, scene.seed, rng_name);
  Report report("dryer", provenance.version, line.scene, static_cast<std::int64_t>(scene.seed));
  ProgressPrinter progress(stderr, line.check ? line.scene : std::filesystem::path(line.output).stem().string(),
                           line.quiet);
  progress.say(granule_line(text, std::nullopt));
  if (const std::string warning = material_warning(text); !warning.empty()) progress.say(warning);
  for (const std::string& fact : describe(scene)) progress.say(fact);
  const ExpectedCost cost = expected_cost(scene);
  progress.say(expected_cost_text(scene, cost, machine));
  report_inputs(report, text, std::nullopt);
  report_regime(report, scene);
  if (line.check) {
    check_start(scene);
    return 0;
  }

  const OwnedOutputs owned(line.written, gas_files(text));
  if (!line.overwrite) require_no_other_result(line.output, provenance, text.resolved());
  const OutputCheckpoint checkpoint(line.output, checkpoint_owner(text, provenance));
  if (line.restart) checkpoint.require();
  if (checkpoint.found()) progress.say("resuming from " + checkpoint.path());
  if (const std::string left = checkpoint.leftovers(); !left.empty()) progress.say(left);
  progress.in_hand("filling the droplet");
  Drying drying({line, text, scene, provenance, cost, progress}, checkpoint);
  const Morphology result = drying.finish();
  checkpoint.remove();
  drying.forget();
  report.add_earlier(checkpoint.used());
  fill_report(report, scene, drying.run(), result, drying.companion());
  report_outcome(report, scene, result);
  report_real_granule(report, scene, result);
  deliver(result_text(result, drying.companion()) + outcome_text(scene, result) + real_granule_text(scene, result),
          [&] { report.write(line.report); });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  wait_without_spinning(argv);
  // Arrays of many particles go back to the system when they are freed; by default glibc keeps what is allocated again.
  mallopt(M_MMAP_THRESHOLD, 1 << 17);
  const std::string_view verb = argc > 1 ? argv[1] : "";
  return run_program("dryer", [&] {
    return verb == "continuum"    ? continuum_command(argc - 1, argv + 1)
           : verb == "conditions" ? conditions_command(argc - 1, argv + 1)
                                  : dry(argc, argv);
  });
}
