// One breakup: an agglomerate carried through the protocol until it has broken.
#pragma once

#include <string>

#include "breaker/course.hpp"
#include "breaker/pieces.hpp"
#include "breaker/scene.hpp"

namespace crumble::breaker {

class BreakupRun {
 public:
  // coarsening: factor on the tolerance (explicit: on the step); the companion that measures the error has another.
  BreakupRun(const BreakerScene& scene, const Agglomerate& start, double coarsening);
  BreakupRun(const BreakupRun&) = delete;
  BreakupRun& operator=(const BreakupRun&) = delete;

  // One step of one piece. Events go into events().
  void step();
  bool finished() const { return finished_; }
  // Whether the last step ended a stage of the protocol.
  bool at_stage_end() const { return at_stage_end_; }
  // Why it ended, if not by breakup.
  std::string ending() const;

  double tolerance() const { return scene_.tolerance * coarsening_; }  // of the implicit integrator
  double time() const { return pieces_[turn_].time(); }
  double stress() const { return protocol_.stress_before(time()); }  // Pa
  Instant now() const { return at(time()); }
  ExpectedSteps expected_steps() const;  // of the whole
  double fraction() const;               // done, a guess: largest use of a contact so far
  Frame laboratory() const;              // all particles; those of lost fragments where they were lost
  const Observation& observation() const { return course_.observation(); }
  const Breakup& breakup() const { return course_.breakup(); }
  const std::vector<Event>& events() const { return course_.events(); }
  IntegratorStatistics statistics() const { return pieces_.statistics(); }
  const Protocol& protocol() const { return protocol_; }

  // The state from which a run of the same scene and start goes on to the same bits.
  void fields(SavedFields& f);

 private:
  const BreakerScene& scene_;
  const Particles& particles_;
  Protocol protocol_;
  std::vector<double> corners_;  // of the history, s: steps end at them
  double coarsening_;
  std::size_t broken_when_lost_;  // particles
  std::size_t turn_ = 0;          // of the piece that moves next
  double window_end_ = 0;         // s; all pieces reach it before any goes beyond (only after breakup)
  Pieces pieces_;
  Course course_;
  bool finished_ = false, broken_ = false, at_stage_end_ = false;

  Instant at(double time) const;
  double next_corner(double time) const;
  std::unique_ptr<Integrator> integrate(const std::vector<double>& radius, Frame frame) const;
  void divide();
  void end_with_breakup();
  void settle();
  void next_turn();
};

}  // namespace crumble::breaker
