#include "breaker/breaking.hpp"

#include <fmt/core.h>

#include <cmath>

#include "breaker/result.hpp"

namespace crumble::breaker {

Breaking::Breaking(const Job& job, const OutputCheckpoint& checkpoint)
    : job_(job),
      saved_(checkpoint.found() ? saved_breakup(checkpoint) : SavedBreakup{}),
      run_(make_run()),
      frames_(checkpoint.found() ? std::make_unique<FrameLog>(job.line.output, saved_.frames)
                                 : std::make_unique<FrameLog>(job.line.output)),
      keeper_(
          checkpoint, job.scene.checkpoint_interval,
          [this](SavedFields& f) {
            save_breakup(f, saved_.progression, companion_ ? companion_->state() : SavedState{}, *run_);
          },
          frames_.get(), [this](const std::string& message) { job_.progress.say(message); }) {
  if (checkpoint.found()) resume(*run_, checkpoint, std::move(saved_.run));
  if (job.scene.estimate_error && !saved_.progression.companion)
    companion_ = std::make_unique<Companion>(job.scene, job.start.agglomerate, job.beside, std::move(saved_.companion));
}

std::unique_ptr<BreakupRun> Breaking::make_run() const {
  return std::make_unique<BreakupRun>(job_.scene, job_.start.agglomerate,
                                      std::ldexp(1, -static_cast<int>(saved_.progression.halvings)));
}

void Breaking::finish() {
  keeper_.guard([&] {
    run_to_the_end();
    while (is_uncertain()) {
      begin_anew();
      run_to_the_end();
    }
    write();
  });
}

void Breaking::put_frame() {
  Progression& p = saved_.progression;
  append_frame(*frames_, *run_, job_.scene);
  p.next_frame = job_.scene.frame_interval * (std::floor(run_->now().measure / job_.scene.frame_interval) + 1);
  p.last_frame = run_->statistics().steps;
}

void Breaking::put_sample() {
  Progression& p = saved_.progression;
  append_sample(*frames_, *run_);
  p.next_sample = job_.scene.sample_interval * (std::floor(run_->now().measure / job_.scene.sample_interval) + 1);
  p.last_sample = run_->statistics().steps;
}

// What is due, once: also after a restart in between.
void Breaking::record() {
  Progression& p = saved_.progression;
  const std::int64_t steps = run_->statistics().steps;
  if (p.last_frame < 0) {
    put_frame();
    p.next_frame = job_.scene.frame_interval;
  }
  if (steps > p.last_sample && (run_->now().measure >= p.next_sample || run_->finished())) put_sample();
  if (steps > p.last_frame && (run_->now().measure >= p.next_frame || run_->at_stage_end() || run_->finished()))
    put_frame();
}

void Breaking::between_steps() {
  keeper_.between_steps([&] { return run_->finished() ? std::string("during the error estimate") : "at " + where(); });
}

std::string Breaking::where() const {
  const Instant now = run_->now();
  return job_.scene.protocol.has_history() ? fmt::format("{:.4g} s, {:.3g} Pa", now.time, now.stress)
                                           : fmt::format("{:.4g} Pa", now.stress);
}

void Breaking::advance() {
  between_steps();
  const auto limit_before = run_->breakup().first_limit;
  run_->step();
  if (!limit_before && run_->breakup().first_limit && job_.scene.is(IntegratorKind::implicit))
    job_.progress.say(fmt::format("rigid but for elastic contacts up to {:.1f} Pa ({} steps); from here it is flexible",
                                  run_->breakup().first_limit->stress, run_->statistics().rigid_steps));
  const ExpectedCost& cost = job_.cost;
  const std::optional<StepRange> steps =
      cost.steps.most > 0 ? std::optional(StepRange{cost.steps.least, cost.steps.most}) : std::nullopt;
  job_.progress.update(
      run_->fraction(), run_->statistics().steps,
      [&] {
        return fmt::format("step {}, {}, {} contacts, largest tension {:.2f} F_po", run_->statistics().steps, where(),
                           run_->observation().contacts, run_->observation().network.max_use);
      },
      steps);
}

void Breaking::run_to_the_end() {
  for (record(); !run_->finished(); record()) advance();
  if (!companion_) return;
  job_.progress.in_hand("error estimate");
  saved_.progression.companion = companion_->outcome([this] { between_steps(); });
  companion_.reset();
}

bool Breaking::is_uncertain() const {
  const Progression& p = saved_.progression;
  const auto error = relative_error(run_->breakup(), p.companion);
  return error && *error > job_.scene.accuracy && job_.scene.is(IntegratorKind::implicit) &&
         p.halvings < job_.scene.halvings;
}

// The run with half of the tolerance; the one before is its companion.
void Breaking::begin_anew() {
  Progression& p = saved_.progression;
  const double outcome = run_->breakup().severed->measure;
  const char* unit = job_.scene.protocol.has_history() ? "s" : "Pa";
  job_.progress.say(fmt::format("{:.5g} {}, with doubled tolerance {:.5g} {}: once more with half of it", outcome, unit,
                                *p.companion, unit));
  p = {.companion = outcome, .halvings = p.halvings + 1};
  run_.reset();
  run_ = make_run();
  frames_->begin_anew();
  keeper_.save();
  frames_->cut();
}

void Breaking::write() {
  job_.progress.in_hand("writing the file");
  AgglomerateWriter writer(job_.line.output, job_.start.agglomerate.particles,
                           {"breaker", job_.provenance, job_.text.given(), job_.text.resolved(), "none"});
  frames_->write_to(writer);
  write_rest(writer, *run_, job_.scene, job_.start, companion());
  write_properties(writer, properties_of(job_.text, job_.parent.properties));
  writer.finish(run_->breakup().severed ? "broken" : "relaxed");
}

}  // namespace crumble::breaker
