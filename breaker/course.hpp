// What an agglomerate goes through on its way to breakup: how it looks, what happens to its contacts, who leaves it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "breaker/pieces.hpp"

namespace crumble::breaker {

// When something happened, and what the run goes by: in a flow that grows its stress, along a history the time.
struct Instant {
  double time = 0, stress = 0;  // s, Pa
  double measure = 0;           // one of them
  bool operator==(const Instant&) const = default;
};

// Size and shape, and what the flow does to the contacts, at one instant.
struct Observation {
  Instant at;
  // Of the largest piece that still moves, m.
  double radius_of_gyration = 0;
  std::array<double, 3> semi_axes{};
  std::int64_t largest_fragment = 0;  // particles
  // Of all pieces that still move.
  std::int64_t contacts = 0;
  NetworkState network;
};

// What the report says about the breakup itself; nothing where it has not happened.
struct Breakup {
  std::optional<Instant> first_limit, first_rupture;  // a contact at any limit; a contact lost
  std::optional<Instant> severed;  // the last load path to what was lost gave way: the critical stress
  std::optional<Instant> lost;     // it was beyond reach
  std::int64_t contacts_initial = 0;
  Observation initial, before;          // at the start of the flow, and whole for the last time
  std::vector<std::int64_t> fragments;  // sizes at the end, descending
};

class Course {
 public:
  Course(const Particles& particles, const Pieces& pieces, const Instant& start);

  const Observation& observation() const { return now_; }
  const Breakup& breakup() const { return breakup_; }
  const std::vector<Event>& events() const { return events_; }
  double max_use() const { return max_use_; }  // largest tension over pull-off force of any contact so far

  // What is not yet broken is kept, once every thousandth of the measure.
  void observe(const Pieces& pieces, const Instant& now);
  // Takes over the events of a piece; by_time: time is the measure. True if a contact was lost.
  bool collect_events(Piece& piece, bool by_time);
  // Who is in the largest fragment of the piece, and when others left it.
  void note_fragments(const Piece& piece, const Instant& now);
  // Fragments were lost: their sizes, in the whole, are those at the end as far as is known.
  void lose(const Instant& now, const std::vector<std::int64_t>& sizes);
  void set_fragments(std::vector<std::int64_t> sizes) { breakup_.fragments = std::move(sizes); }

  // As many particles as make a breakup have left `kept`. The critical stress is that at which the decisive one had.
  void end_with_breakup(const Piece& kept, std::size_t particles_lost, const Instant& now);
  void end_unbroken();

  void fields(SavedFields& f);

 private:
  const Particles& particles_;
  std::vector<Instant> severed_at_;  // when each particle left the largest fragment; at infinity: it is in it
  std::vector<Event> events_;
  std::vector<Observation> past_;
  Observation now_;
  Breakup breakup_;
  double max_use_ = 0;

  void note(Event event);
  void find_whole_before(double measure);
};

}  // namespace crumble::breaker
