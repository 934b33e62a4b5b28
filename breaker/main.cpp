// Breaks one agglomerate in a flow that grows: scene and agglomerate in, breakup file out.
#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "breaker/breakup_checkpoint.hpp"
#include "breaker/companion.hpp"
#include "breaker/result.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/io/command_line.hpp"
#include "common/io/errors.hpp"
#include "common/io/granule.hpp"
#include "common/io/interrupt.hpp"
#include "common/io/machine.hpp"
#include "common/io/output_lock.hpp"
#include "common/io/program.hpp"

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
           {"breaker breakup.toml breakup.h5 -o more.h5 --set particle.contacts=keep", "a fragment goes on"}},
          version_text("breaker"),
          breaker_parameters(),
          true};
}

void put_frame(AgglomerateWriter& writer, const BreakupRun& run, const BreakerScene& scene, Progression& p) {
  append_frame(writer, run, scene);
  p.next_frame = scene.frame_interval * (std::floor(run.stress() / scene.frame_interval) + 1);
  p.last_step = run.statistics().steps;
}

void put_sample(AgglomerateWriter& writer, const BreakupRun& run, const BreakerScene& scene, Progression& p) {
  append_sample(writer, run);
  p.next_sample = scene.sample_interval * (std::floor(run.stress() / scene.sample_interval) + 1);
  p.last_step = run.statistics().steps;
}

void advance(BreakupRun& run, const BreakerScene& scene, AgglomerateWriter& writer, Progression& p,
             ProgressPrinter& progress) {
  const auto limit_before = run.breakup().first_limit;
  run.step();
  if (!limit_before && run.breakup().first_limit && !scene.is_explicit)
    progress.say(fmt::format("rigid but for elastic contacts up to {:.1f} Pa ({} steps); from here it is flexible",
                             *run.breakup().first_limit, run.statistics().rigid_steps));
  if (run.stress() >= p.next_sample) put_sample(writer, run, scene, p);
  if ((run.stress() >= p.next_frame || run.at_stage_end()) && !run.finished()) put_frame(writer, run, scene, p);
  progress.update(run.fraction(), run.statistics().steps, [&] {
    return fmt::format("step {}, {:.0f} Pa, {} contacts, largest tension {:.2f} F_po", run.statistics().steps,
                       run.stress(), run.look().contacts, run.look().network.max_use);
  });
}

// Steps to the end. Whatever ends it early leaves a checkpoint.
void run_to_the_end(BreakupRun& run, const BreakerScene& scene, AgglomerateWriter& writer, Companion* companion,
                    BreakupCheckpoint& checkpoint, Progression& p, ProgressPrinter& progress) {
  try {
    if (writer.frame_count() == 0) {
      put_frame(writer, run, scene, p);
      p.next_frame = scene.frame_interval;
    }
    while (!run.finished()) {
      advance(run, scene, writer, p, progress);
      if (interrupt_signal()) throw Interrupted(interrupt_signal(), fmt::format("stopped at {:g} Pa", run.stress()));
    }
    if (companion && !p.companion) p.companion = companion->critical_stress();
  } catch (const std::exception& error) {
    if (companion && companion->done()) p.companion = companion->critical_stress();
    keep_and_rethrow([&] {
      writer.suspend();
      checkpoint.save(run, p);
      progress.say(fmt::format("the state is kept in {}; the same command goes on from there", checkpoint.path()));
    });
  }
}

struct Job {
  const CommandLine& line;
  const Scene& text;
  const BreakerScene& scene;
  const Parent& parent;
  const Start& start;
  const Provenance& provenance;
  BreakupCheckpoint& checkpoint;
  ProgressPrinter& progress;
  Report& report;
};

bool is_uncertain(const BreakupRun& run, const BreakerScene& scene, const Progression& p) {
  const auto error = relative_error(run.breakup(), p.companion);
  return error && *error > scene.accuracy && !scene.is_explicit && p.halvings < scene.halvings;
}

// One run with its output. False if its error is too large: then p says how to begin the next one.
bool break_once(const Job& job, Progression& p, bool goes_on, bool beside) {
  const BreakerScene& scene = job.scene;
  BreakupRun run(scene, job.start.agglomerate, std::ldexp(1, -static_cast<int>(p.halvings)));
  if (goes_on) job.checkpoint.resume(run);
  std::optional<Companion> companion;
  if (scene.estimate_error && !p.companion) companion.emplace(scene, job.start.agglomerate, beside);
  AgglomerateWriter writer =
      goes_on ? AgglomerateWriter::resume(job.line.output, p.last_step)
              : AgglomerateWriter(job.line.output, job.start.agglomerate.particles,
                                  {"breaker", job.provenance, job.text.given(), job.text.resolved(), "none"});
  run_to_the_end(run, scene, writer, companion ? &*companion : nullptr, job.checkpoint, p, job.progress);
  if (is_uncertain(run, scene, p)) {
    job.progress.say(fmt::format("{:.1f} Pa, with doubled tolerance {:.1f} Pa: once more with half of it",
                                 *run.breakup().severed, *p.companion));
    job.checkpoint.remove();
    p = {.companion = run.breakup().severed, .halvings = p.halvings + 1};
    return false;
  }
  if (run.statistics().steps > p.last_step) {
    put_sample(writer, run, scene, p);
    put_frame(writer, run, scene, p);
  }
  write_rest(writer, run, scene, job.start);
  write_properties(writer, properties_of(job.text, job.parent.properties));
  writer.finish(run.breakup().severed ? "broken" : "relaxed");
  job.checkpoint.remove();
  fill_report(job.report, scene, job.start, run, p.companion);
  deliver(result_text(run, scene, p.companion), [&] { job.report.write(job.line.report); });
  return true;
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
  const int threads = line.threads > 0 ? line.threads : default_threads(omp_get_max_threads(), this_machine());
  omp_set_num_threads(1);  // beside each other the run and its companion use two cores
  const Provenance provenance = make_provenance("breaker", {argv, argv + argc}, 0, "none", input);
  Report report("breaker", provenance.version, line.scene, std::nullopt);
  ProgressPrinter progress(stderr, line.check ? line.scene : std::filesystem::path(line.output).stem().string(),
                           line.quiet);
  progress.say(granule_line(text, parent));
  report_inputs(report, text, parent);
  const Start start = make_start(std::move(agglomerate), input, scene);
  adapt(scene, start.rigid_strength);
  for (const std::string& fact : describe(scene, start)) progress.say(fact);
  if (line.check) {
    const BreakupRun builds(scene, start.agglomerate, 1);
    return 0;
  }

  const OwnedOutputs owned(line.written, {});
  BreakupCheckpoint checkpoint(line.output,
                               {"breaker", provenance.version, text.resolved() + "\n# of " + provenance.parent_sha256});
  if (line.restart) checkpoint.require();
  if (checkpoint.found()) progress.say("resuming from " + checkpoint.path());
  Progression p = checkpoint.found() ? checkpoint.progression() : Progression{};
  report.add_earlier(checkpoint.used());
  const Job job{line, text, scene, parent, start, provenance, checkpoint, progress, report};
  bool goes_on = checkpoint.found();
  while (!break_once(job, p, goes_on, threads > 1)) goes_on = false;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  wait_without_spinning(argv);
  return run_program("breaker", [&] { return break_up(argc, argv); });
}
