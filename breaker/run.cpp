#include "breaker/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "breaker/explicit_euler.hpp"
#include "breaker/implicit.hpp"
#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/io/errors.hpp"

namespace crumble::breaker {

BreakupRun::BreakupRun(const BreakerScene& scene, const Agglomerate& start, double coarsening)
    : scene_(scene),
      particles_(start.particles),
      protocol_(scene.protocol),
      coarsening_(coarsening),
      broken_when_lost_(scene.lost_particles ? static_cast<std::size_t>(*scene.lost_particles)
                                             : (start.particles.size() + 19) / 20),
      pieces_(start.particles, start.state,
              [this](const std::vector<double>& radius, Frame frame) { return integrate(radius, std::move(frame)); }),
      course_(start.particles, pieces_, now()) {
  corners_ = protocol_.corners(tolerance(), scene.model.weak_stress);
}

Instant BreakupRun::at(double time) const {
  const double stress = protocol_.stress_before(time);
  return {time, stress, protocol_.has_history() ? time : stress};
}

double BreakupRun::next_corner(double time) const {
  const auto next = std::upper_bound(corners_.begin(), corners_.end(), time);
  return next == corners_.end() ? std::numeric_limits<double>::infinity() : *next;
}

std::unique_ptr<Integrator> BreakupRun::integrate(const std::vector<double>& radius, Frame frame) const {
  if (scene_.is(IntegratorKind::explicit_euler)) {
    try {
      return std::make_unique<ExplicitEuler>(scene_.model, protocol_, radius, std::move(frame), scene_.step,
                                             scene_.allow_unstable, coarsening_);
    } catch (const std::invalid_argument& error) {
      throw InputError(std::string("integrator.step: ") + error.what());
    }
  }
  return std::make_unique<Implicit>(scene_.model, protocol_, radius, std::move(frame), tolerance());
}

std::string BreakupRun::ending() const {
  if (broken_ || !finished_) return "";
  if (protocol_.has_history()) return fmt::format("nothing broke until the end of the history, {:g} s", time());
  if (stress() < scene_.largest_stress) return "nothing broke until the end of the protocol";
  return fmt::format("nothing broke up to protocol.largest_stress = {:g} Pa", scene_.largest_stress);
}

// Half of the steps are done where the rigid agglomerate would break, measured; how far beyond it holds is not known.
double BreakupRun::fraction() const {
  if (broken_ || finished_) return 1;
  if (protocol_.has_history()) return std::min(time() / protocol_.end(), 0.99);
  if (scene_.rigid_strength <= 0) return std::clamp(course_.max_use(), 0.0, 0.99);
  const double x = stress() / scene_.rigid_strength;
  return std::min(x / (1 + x), 0.99);
}

ExpectedSteps BreakupRun::expected_steps() const {
  ExpectedSteps steps = pieces_[0].integrator->expected_steps(scene_.rigid_strength);
  if (!protocol_.has_history() || scene_.is(IntegratorKind::explicit_euler)) return steps;
  // Turning loads take steps too: up to 35 a unit of strain, measured on a granule of 40 that tumbled near a wall and
  // yielded at every turn.
  const auto corners = static_cast<double>(corners_.size());
  const double strain = protocol_.strain(protocol_.end()) / scene_.model.viscosity;
  return {std::min(steps.least, corners), steps.most + corners + 40 * strain};
}

Frame BreakupRun::laboratory() const {
  Frame frame = pieces_.laboratory();
  frame.time = time();
  return frame;
}

void BreakupRun::step() {
  if (finished_) return;
  Piece& piece = pieces_[turn_];
  const double latest = broken_ ? window_end_ : protocol_.stage_end(piece.time());
  const bool changed = piece.integrator->step(std::min(latest, next_corner(piece.time())));
  at_stage_end_ = !broken_ && piece.time() == latest;
  course_.observe(pieces_, now());
  if (course_.collect_events(piece, protocol_.has_history())) piece.last_rupture = piece.time();
  if (changed) {
    course_.note_fragments(piece, now());
    course_.set_fragments(fragment_sizes(fragments(particles_.size(), laboratory().contacts)));
  }
  divide();
  if (finished_) return;
  if (broken_) {
    next_turn();
  } else if ((!protocol_.has_history() && stress() >= scene_.largest_stress) || time() >= protocol_.end()) {
    finished_ = true;
    course_.end_unbroken();
  }
}

// Fragments of the piece in turn that are beyond reach are lost. Before breakup small ones stay where they were lost;
// afterwards whatever can break goes on alone.
void BreakupRun::divide() {
  const Instant instant = now();
  std::vector<Piece> parts = pieces_.split(turn_, scene_.reach * mean_radius(particles_));
  if (parts.empty()) return;
  const bool breaks = !broken_ && particles_.size() - pieces_[turn_].member.size() >= broken_when_lost_;
  for (Piece& part : parts)
    if ((broken_ || breaks) && part.member.size() > 1) pieces_.add(std::move(part));
  course_.lose(instant, fragment_sizes(fragments(particles_.size(), pieces_.laboratory().contacts)));
  if (breaks) end_with_breakup();
}

void BreakupRun::end_with_breakup() {
  broken_ = true;
  course_.end_with_breakup(pieces_[0], broken_when_lost_, now());
  if (scene_.until_stable)
    settle();
  else
    finished_ = true;
}

// From now on the stress is held; a history goes on to its end. Window after window of a strain of one all pieces move,
// one after the other.
void BreakupRun::settle() {
  window_end_ = time();
  if (protocol_.has_history()) return next_turn();
  const double now = time(), stress = protocol_.stress_before(now);
  std::vector<Stage> stages;
  double begin = 0;
  for (const Stage& stage : protocol_.stages()) {
    if (begin >= now) break;
    stages.push_back(stage);
    stages.back().duration = std::min(stage.duration, now - begin);
    begin += stage.duration;
  }
  stages.push_back({stress, 0, std::numeric_limits<double>::infinity()});
  protocol_ = Protocol(std::move(stages));
  next_turn();
}

void BreakupRun::next_turn() {
  const auto behind =
      std::find_if(pieces_.begin(), pieces_.end(), [&](const Piece& piece) { return piece.time() < window_end_; });
  if (behind != pieces_.end()) {
    turn_ = static_cast<std::size_t>(behind - pieces_.begin());
    return;
  }
  turn_ = 0;
  if (protocol_.has_history()) {
    finished_ = window_end_ >= protocol_.end();
    window_end_ = std::min(window_end_ + 1 / protocol_.history().largest_rate(), protocol_.end());
    return;
  }
  const double strain = scene_.model.viscosity / protocol_.stress_before(window_end_);
  if (std::all_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
        return window_end_ - piece.last_rupture >= scene_.stable_strain * strain;
      }))
    finished_ = true;
  else
    window_end_ += strain;
}

void BreakupRun::fields(SavedFields& f) {
  std::vector<Stage> stages = protocol_.stages();
  f.size("stages", stages);
  f.column("stages.stress", stages, &Stage::stress);
  f.column("stages.rate", stages, &Stage::rate);
  f.column("stages.duration", stages, &Stage::duration);
  if (f.loading() && !protocol_.has_history()) protocol_ = Protocol(std::move(stages));
  f("turn", turn_);
  f("window_end", window_end_);
  f("broken", broken_);
  f("finished", finished_);
  f("at_stage_end", at_stage_end_);
  SavedFields pieces = f.in("pieces"), course = f.in("course");
  pieces_.fields(pieces);
  course_.fields(course);
}

}  // namespace crumble::breaker
