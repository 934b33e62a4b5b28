#include "dryer/drying.hpp"

#include <fmt/core.h>

#include <filesystem>

#include "common/io/granule.hpp"
#include "dryer/result.hpp"

namespace crumble::dryer {

namespace {

SavedDrying beginning(const DryingScene& scene) {
  SavedDrying saved;
  saved.progress.estimated = !scene.estimate_error;
  saved.run = std::make_unique<DryingRun>(scene, coarsening(saved.progress));
  return saved;
}

}  // namespace

Drying::Drying(const Job& job, const OutputCheckpoint& checkpoint)
    : job_(job),
      saved_(checkpoint.found() ? saved_drying(checkpoint, job.scene) : beginning(job.scene)),
      frames_(checkpoint.found() ? std::make_unique<FrameLog>(job.line.output, saved_.frames)
                                 : std::make_unique<FrameLog>(job.line.output)),
      keeper_(
          checkpoint, job.scene.checkpoint_interval,
          [this](SavedFields& f) { save_drying(f, saved_.progress, *saved_.run); }, frames_.get(),
          [this](const std::string& message) { job_.progress.say(message); }) {}

Morphology Drying::finish() {
  Morphology result;
  keeper_.guard([&] {
    if (!saved_.progress.estimated) estimate();
    run_to_the_end();
    result = morphology(run().state().particles, run().state().state);
    write(result);
  });
  return result;
}

std::string Drying::name() const { return std::filesystem::path(job_.line.output).stem().string(); }

void Drying::advance() {
  keeper_.between_steps([&] {
    return saved_.progress.estimated ? fmt::format("at t = {:g} s", run().state().state.time)
                                     : std::string("during the error estimate");
  });
  saved_.run->step();
  job_.progress.update(job_.cost.work.share(run().fraction()), run().integrator().statistics().steps, [&] {
    return fmt::format("R = {:.3g} nm, {} contacts", run().droplet_radius() * 1e9, run().state().state.contacts.size());
  });
}

void Drying::estimate() {
  job_.progress.begin(name() + ", error estimate");
  while (!run().finished()) advance();
  const DryingOutcome found = outcome(morphology(run().state().particles, run().state().state));
  saved_.run.reset();  // not two of them in memory
  saved_.run = std::make_unique<DryingRun>(job_.scene, 1);
  saved_.progress.companion = found;
  saved_.progress.estimated = true;
}

// The frame at the start, those whose radius the front has passed, and the last one at the end.
int Drying::frames_due() const { return 1 + run().frames_passed() + (run().finished() ? 1 : 0); }

void Drying::run_to_the_end() {
  job_.progress.begin(name());
  for (;;) {
    if (frames_due() > saved_.progress.frames) {
      append_frame(*frames_, run());
      saved_.progress.frames = frames_due();
    }
    if (run().finished()) return;
    advance();
  }
}

void Drying::write(const Morphology& result) {
  job_.progress.in_hand("writing the file");
  AgglomerateWriter writer(job_.line.output, run().state().particles,
                           {"dryer", job_.provenance, job_.text.given(), job_.text.resolved(), "total"});
  frames_->write_to(writer);
  write_morphology(writer, result);
  write_errors(writer, result, companion());
  Properties properties = properties_of(job_.text);
  properties["fluid.viscosity"] = job_.scene.model.viscosity;  // where the scene says "water", water's
  write_properties(writer, properties);
  writer.finish("dry");
}

}  // namespace crumble::dryer
