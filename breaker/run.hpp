// One breakup: an agglomerate carried through the protocol until it has broken.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "breaker/integrator.hpp"
#include "breaker/scene.hpp"

namespace crumble {

// Size and shape, and what the flow does to the contacts, at one instant.
struct Look {
  double stress = 0;  // Pa
  double radius_of_gyration = 0;
  std::array<double, 3> semi_axes{};
  std::int64_t contacts = 0, largest_fragment = 0;
  NetworkState network;
};

// What the report says about the breakup itself. Stresses in Pa; nothing where it has not happened.
struct Breakup {
  std::optional<double> first_limit, first_rupture;  // a contact at any limit; a contact lost
  std::optional<double> severed;  // the last load path to what was lost gave way: the critical stress
  std::optional<double> lost;     // it was beyond reach
  std::int64_t contacts_initial = 0;
  Look initial, before;                 // at the start of the flow, and whole for the last time
  std::vector<std::int64_t> fragments;  // sizes at the end, descending
};

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
  double time() const;
  double stress() const;     // Pa
  double fraction() const;   // done, a guess: largest use of a contact so far
  Frame laboratory() const;  // all particles; those of lost fragments where they were lost
  const Look& look() const { return look_; }
  const Breakup& breakup() const { return breakup_; }
  const std::vector<Event>& events() const { return events_; }
  IntegratorStatistics statistics() const;
  const Protocol& protocol() const { return protocol_; }
  // A state from which a run goes on to the same bits.
  bool can_be_saved() const;

  struct Memory {
    std::vector<double> numbers;
    std::vector<std::int64_t> counts;
    std::vector<Frame> frames;  // of each piece, own axes
    std::vector<std::vector<std::int64_t>> members, told;
    std::vector<Integrator::Memory> integrators;
    Frame whole;
  };
  Memory memory() const;
  void recall(const Memory& memory);

 private:
  // Particles that still act on each other.
  struct Piece {
    std::vector<std::int32_t> member;  // particle numbers, ascending
    std::unique_ptr<Integrator> integrator;
    double last_rupture = 0;  // s
  };
  const BreakerScene& scene_;
  const Particles& particles_;
  Protocol protocol_;
  double coarsening_;
  std::size_t broken_when_lost_;  // particles
  std::vector<Piece> pieces_;
  std::size_t turn_ = 0;            // of the piece that moves next
  double window_end_ = 0;           // s; all pieces reach it before any goes beyond (only after breakup)
  Frame whole_;                     // what is no longer in any piece
  std::vector<double> severed_at_;  // stress at which each particle left the largest fragment, -1: it is in it
  std::vector<Event> events_;
  std::vector<Look> past_;  // a look every thousandth of the stress
  Look look_;
  Breakup breakup_;
  double max_use_ = 0;
  IntegratorStatistics retired_;  // of integrators that are gone
  bool finished_ = false, broken_ = false, at_stage_end_ = false;

  std::unique_ptr<Integrator> integrate(const Piece& piece, Frame frame) const;
  Frame part_of(const Frame& frame, const std::vector<std::int32_t>& rows) const;
  void put_back(const Piece& piece);
  void collect_events(const Piece& piece);
  void note_fragments(const Piece& piece);
  void divide(std::size_t number);
  double critical_stress() const;
  void end_with_breakup();
  void settle();
  void next_turn();
  void observe();
  void look_back(double stress);
};

}  // namespace crumble
