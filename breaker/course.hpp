// What an agglomerate goes through on its way to breakup: how it looks, what happens to its contacts, who leaves it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "breaker/pieces.hpp"

namespace crumble::breaker {

// Size and shape, and what the flow does to the contacts, at one instant.
struct Observation {
  double stress = 0;  // Pa
  // Of the largest piece that still moves, m.
  double radius_of_gyration = 0;
  std::array<double, 3> semi_axes{};
  std::int64_t largest_fragment = 0;  // particles
  // Of all pieces that still move.
  std::int64_t contacts = 0;
  NetworkState network;
};

// What the report says about the breakup itself. Stresses in Pa; nothing where it has not happened.
struct Breakup {
  std::optional<double> first_limit, first_rupture;  // a contact at any limit; a contact lost
  std::optional<double> severed;  // the last load path to what was lost gave way: the critical stress
  std::optional<double> lost;     // it was beyond reach
  std::int64_t contacts_initial = 0;
  Observation initial, before;          // at the start of the flow, and whole for the last time
  std::vector<std::int64_t> fragments;  // sizes at the end, descending
};

class Course {
 public:
  // pieces, stress: at the start.
  Course(const Particles& particles, const Pieces& pieces, double stress);

  const Observation& observation() const { return now_; }
  const Breakup& breakup() const { return breakup_; }
  const std::vector<Event>& events() const { return events_; }
  double max_use() const { return max_use_; }  // largest tension over pull-off force of any contact so far

  // Observes the pieces under a stress. What is not yet broken is kept, once every thousandth of the stress.
  void observe(const Pieces& pieces, double stress);
  // Takes over the events of a piece. True if a contact was lost.
  bool collect_events(Piece& piece);
  // Who is in the largest fragment of the piece, and at which stress others left it.
  void note_fragments(const Piece& piece, double stress);
  // Fragments were lost: their sizes, in the whole, are those at the end as far as is known.
  void lose(double time, double stress, const std::vector<std::int64_t>& sizes);
  void set_fragments(std::vector<std::int64_t> sizes) { breakup_.fragments = std::move(sizes); }

  // As many particles as make a breakup have left `kept`. The critical stress is that at which the decisive one had.
  void end_with_breakup(const Piece& kept, std::size_t particles_lost, double stress);
  void end_unbroken();

  void fields(SavedFields& f);

 private:
  const Particles& particles_;
  std::vector<double> severed_at_;  // stress at which each particle left the largest fragment; infinite: it is in it
  std::vector<Event> events_;
  std::vector<Observation> past_;
  Observation now_;
  Breakup breakup_;
  double max_use_ = 0;

  void note(Event event);
  void find_whole_before(double stress);
};

}  // namespace crumble::breaker
