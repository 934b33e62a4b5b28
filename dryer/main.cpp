// Dries one droplet of colloid: scene in, agglomerate file out.
#include <fmt/core.h>
#include <malloc.h>
#include <omp.h>

#include <filesystem>
#include <string_view>

#include "common/io/command_line.hpp"
#include "common/io/granule.hpp"
#include "common/io/interrupt.hpp"
#include "common/io/machine.hpp"
#include "common/io/output_lock.hpp"
#include "common/io/program.hpp"
#include "common/io/provenance.hpp"
#include "common/numerics/noise.hpp"
#include "dryer/continuum_command.hpp"
#include "dryer/drying_checkpoint.hpp"
#include "dryer/expected_cost.hpp"
#include "dryer/regime.hpp"
#include "dryer/result.hpp"
#include "dryer/scene.hpp"

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
           {"dryer hollow.toml --check", "say what the scene means, run nothing"},
           {"dryer continuum --peclet 1 --theta 0.2,0.4 -o continuum.csv",
            "concentration of point particles; dryer continuum --help explains"}},
          version_text("dryer"),
          drying_parameters(),
          true};
}

// How many of the frames after the first are due: those whose radius the front has passed, and the last one at the end.
int frames_due(const DryingRun& run) { return run.frames_passed() + (run.finished() ? 1 : 0); }

void advance(DryingRun& run, const ExpectedCost& cost, ProgressPrinter& progress) {
  run.step();
  progress.update(cost.share(run.fraction()), run.integrator().statistics().steps, [&] {
    return fmt::format("R = {:.3g} nm, {} contacts", run.droplet_radius() * 1e9, run.state().state.contacts.size());
  });
}

DryingOutcome run_companion(const DryingScene& scene, const ExpectedCost& cost, const CommandLine& line) {
  ProgressPrinter progress(stderr, std::filesystem::path(line.output).stem().string() + ", error estimate", line.quiet);
  DryingRun run(scene, 2);
  while (!run.finished()) {
    advance(run, cost, progress);
    if (interrupt_signal())
      throw Interrupted(interrupt_signal(), "stopped during the error estimate: nothing to keep yet");
  }
  return outcome(morphology(run.state().particles, run.state().state));
}

AgglomerateWriter open_writer(const CommandLine& line, const Scene& scene, const Provenance& provenance,
                              const DryingRun& run) {
  return {line.output, run.state().particles, {"dryer", provenance, scene.given(), scene.resolved(), "total"}};
}

// Steps to the end and writes the frames that fall due. Whatever ends it early leaves a checkpoint.
void run_to_the_end(DryingRun& run, AgglomerateWriter& writer, const DryingCheckpoint& checkpoint, DryingProgress done,
                    const ExpectedCost& cost, ProgressPrinter& progress) {
  const auto frame = [&](int number) {
    append_frame(writer, run);
    done.frames = number;
    done.last_frame_step = run.state().state.step;
  };
  try {
    if (done.frames == 0) frame(1);
    while (!run.finished()) {
      advance(run, cost, progress);
      if (frames_due(run) >= done.frames) frame(frames_due(run) + 1);
      if (interrupt_signal())
        throw Interrupted(interrupt_signal(), fmt::format("stopped at t = {:g} s", run.state().state.time));
    }
  } catch (const std::exception& error) {
    keep_and_rethrow([&] {
      writer.suspend();
      checkpoint.save(run, done);
      progress.say(fmt::format("the state is kept in {}; the same command goes on from there", checkpoint.path()));
    });
  }
}

int dry(int argc, const char* const* argv) {
  const CommandLine line = parse_command_line(description(), argc, argv);
  if (line.answer) {
    deliver(*line.answer);
    return 0;
  }
  const Machine machine = this_machine();
  omp_set_num_threads(line.threads > 0 ? line.threads : default_threads(omp_get_max_threads(), machine));
  const Scene text = Scene::read(line.scene, drying_parameters(), line.overrides);
  const DryingScene scene = drying_scene(text, machine);
  const Provenance provenance = make_provenance("dryer", {argv, argv + argc}, scene.seed, rng_name);
  Report report("dryer", provenance.version, line.scene, static_cast<std::int64_t>(scene.seed));
  ProgressPrinter progress(stderr, line.check ? line.scene : std::filesystem::path(line.output).stem().string(),
                           line.quiet);
  progress.say(granule_line(text, std::nullopt));
  for (const std::string& fact : describe(scene)) progress.say(fact);
  const ExpectedCost cost = expected_cost(scene);
  progress.say(expected_cost_text(scene, cost, machine));
  report_inputs(report, text, std::nullopt);
  report_regime(report, scene);
  if (line.check) {
    check_start(scene);
    return 0;
  }

  const OwnedOutputs owned(line.written, {});
  DryingCheckpoint checkpoint(line.output, {"dryer", provenance.version, text.resolved()});
  if (line.restart) checkpoint.require();
  if (checkpoint.found()) progress.say("resuming from " + checkpoint.path());
  DryingProgress done = checkpoint.found() ? checkpoint.progress() : DryingProgress{};
  if (!checkpoint.found() && scene.estimate_error) done.companion = run_companion(scene, cost, line);
  DryingRun run = checkpoint.found() ? checkpoint.resume(scene) : DryingRun(scene, 1);
  AgglomerateWriter writer = checkpoint.found() ? AgglomerateWriter::resume(line.output, done.last_frame_step)
                                                : open_writer(line, text, provenance, run);
  run_to_the_end(run, writer, checkpoint, done, cost, progress);

  const Morphology result = morphology(run.state().particles, run.state().state);
  write_morphology(writer, result);
  Properties properties = properties_of(text);
  properties["fluid.viscosity"] = scene.model.viscosity;  // where the scene says "water", water's
  write_properties(writer, properties);
  writer.finish("dry");
  checkpoint.remove();
  report.add_earlier(checkpoint.used());
  fill_report(report, scene, run, result, done.companion);
  deliver(result_text(result, done.companion), [&] { report.write(line.report); });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  wait_without_spinning(argv);
  // Arrays of many particles go back to the system when they are freed; by default glibc keeps what is allocated again.
  mallopt(M_MMAP_THRESHOLD, 1 << 17);
  const bool continuum = argc > 1 && std::string_view(argv[1]) == "continuum";
  return run_program("dryer", [&] { return continuum ? continuum_command(argc - 1, argv + 1) : dry(argc, argv); });
}
