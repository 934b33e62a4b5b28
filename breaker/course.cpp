#include "breaker/course.hpp"

#include <algorithm>
#include <limits>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"

namespace crumble::breaker {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Instant never{infinite, infinite, infinite};

void instant_fields(SavedFields f, std::vector<Instant>& all) {
  f.column("time", all, &Instant::time);
  f.column("stress", all, &Instant::stress);
  f.column("measure", all, &Instant::measure);
}

void instant_fields(SavedFields f, std::optional<Instant>& instant) {
  std::vector<Instant> one;
  if (instant) one.push_back(*instant);
  f.size("count", one);
  instant_fields(f, one);
  if (one.empty())
    instant.reset();
  else
    instant = one.front();
}

void observation_fields(SavedFields f, std::vector<Observation>& all) {
  const auto column = [&](const char* name, auto member) { f.column(name, all, member); };
  column("radius_of_gyration", &Observation::radius_of_gyration);
  column("semi_axes", &Observation::semi_axes);
  column("largest_fragment", &Observation::largest_fragment);
  column("contacts", &Observation::contacts);
  std::vector<NetworkState> network;
  std::vector<Instant> at;
  for (const Observation& seen : all) {
    network.push_back(seen.network);
    at.push_back(seen.at);
  }
  instant_fields(f, at);
  f.column("max_tension", network, &NetworkState::max_tension);
  f.column("max_use", network, &NetworkState::max_use);
  f.column("slipping", network, &NetworkState::slipping);
  f.column("twisting", network, &NetworkState::twisting);
  f.column("rolling", network, &NetworkState::rolling);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].network = network[k];
    all[k].at = at[k];
  }
}

void observation_fields(SavedFields f, Observation& seen) {
  std::vector<Observation> one{seen};
  observation_fields(f, one);
  seen = one.front();
}

}  // namespace

Course::Course(const Particles& particles, const Pieces& pieces, const Instant& start)
    : particles_(particles), severed_at_(particles.size(), never) {
  const std::vector<Contact>& contacts = pieces[0].frame().contacts;
  breakup_.contacts_initial = static_cast<std::int64_t>(contacts.size());
  breakup_.fragments = fragment_sizes(fragments(particles.size(), contacts));
  note_fragments(pieces[0], start);
  observe(pieces, start);
  breakup_.initial = breakup_.before = now_;
}

void Course::observe(const Pieces& pieces, const Instant& now) {
  now_ = {};
  now_.at = now;
  const Piece* largest = &pieces[0];
  for (const Piece& piece : pieces) {
    const std::vector<Contact>& contacts = piece.frame().contacts;
    if (piece.member.size() > largest->member.size()) largest = &piece;
    now_.contacts += static_cast<std::int64_t>(contacts.size());
    now_.largest_fragment =
        std::max(now_.largest_fragment, fragment_sizes(fragments(piece.member.size(), contacts)).front());
    const NetworkState n = network_state(contacts, piece.integrator->network().laws());
    now_.network.max_tension = std::max(now_.network.max_tension, n.max_tension);
    now_.network.max_use = std::max(now_.network.max_use, n.max_use);
    now_.network.slipping += n.slipping;
    now_.network.twisting += n.twisting;
    now_.network.rolling += n.rolling;
  }
  const std::vector<double> radius = of_members(particles_.radius, largest->member),
                            mass = of_members(particles_.mass, largest->member);
  now_.radius_of_gyration = radius_of_gyration(largest->frame().position, mass);
  now_.semi_axes = semi_axes(largest->frame().position, radius, mass);
  max_use_ = std::max(max_use_, now_.network.max_use);
  if (!breakup_.severed && (past_.empty() || now.measure > 1.001 * past_.back().at.measure)) past_.push_back(now_);
}

// In order of time: pieces that move one after the other tell of the same interval.
void Course::note(Event event) {
  const auto place = std::upper_bound(events_.begin(), events_.end(), event,
                                      [](const Event& a, const Event& b) { return a.time < b.time; });
  events_.insert(place, std::move(event));
}

bool Course::collect_events(Piece& piece, bool by_time) {
  bool ruptured = false;
  for (Event& e : piece.integrator->network().take_events()) {
    e.i = piece.member[e.i];
    e.j = piece.member[e.j];
    const bool at_limit = e.kind == EventKind::slip || e.kind == EventKind::twist || e.kind == EventKind::roll;
    const Instant at{e.time, e.stress, by_time ? e.time : e.stress};
    if (e.kind == EventKind::rupture) ruptured = true;
    if (e.kind == EventKind::rupture && !breakup_.first_rupture) breakup_.first_rupture = at;
    if (at_limit && !breakup_.first_limit) breakup_.first_limit = at;
    note(std::move(e));
  }
  return ruptured;
}

void Course::note_fragments(const Piece& piece, const Instant& now) {
  const auto label = fragments(piece.member.size(), piece.frame().contacts);
  for (std::size_t row = 0; row < label.size(); ++row) {
    Instant& severed = severed_at_[piece.member[row]];
    if (label[row] == 0)
      severed = never;
    else if (severed == never)
      severed = now;
  }
}

void Course::lose(const Instant& now, const std::vector<std::int64_t>& sizes) {
  note({now.time, now.stress, EventKind::fragment_lost, -1, -1, sizes});
  breakup_.fragments = sizes;
}

// What it looked like shortly before: once the last avalanche has begun shape says nothing about the way to it.
void Course::find_whole_before(double measure) {
  for (const Observation& seen : past_)
    if (seen.at.measure <= 0.99 * measure) breakup_.before = seen;
}

void Course::end_with_breakup(const Piece& kept, std::size_t particles_lost, const Instant& now) {
  std::vector<bool> lost(particles_.size(), true);
  for (const std::int32_t p : kept.member) lost[p] = false;
  std::vector<Instant> severed;
  for (std::size_t p = 0; p < lost.size(); ++p)
    if (lost[p]) severed.push_back(severed_at_[p]);
  const auto decisive = severed.begin() + static_cast<std::ptrdiff_t>(particles_lost - 1);
  std::nth_element(severed.begin(), decisive, severed.end(),
                   [](const Instant& a, const Instant& b) { return a.time < b.time; });
  breakup_.severed = *decisive;
  breakup_.lost = now;
  find_whole_before(decisive->measure);
}

void Course::end_unbroken() {
  if (!past_.empty()) breakup_.before = past_.back();
}

void Course::fields(SavedFields& f) {
  observation_fields(f.in("observation"), now_);
  observation_fields(f.in("initial"), breakup_.initial);
  observation_fields(f.in("before"), breakup_.before);
  f.size("past", past_);
  observation_fields(f.in("past"), past_);
  instant_fields(f.in("first_limit"), breakup_.first_limit);
  instant_fields(f.in("first_rupture"), breakup_.first_rupture);
  instant_fields(f.in("severed"), breakup_.severed);
  instant_fields(f.in("lost"), breakup_.lost);
  f("contacts_initial", breakup_.contacts_initial);
  f("fragments", breakup_.fragments);
  instant_fields(f.in("severed_at"), severed_at_);
  f("max_use", max_use_);
  f.size("events", events_);
  f.column("events.time", events_, &Event::time);
  f.column("events.stress", events_, &Event::stress);
  f.column("events.kind", events_, &Event::kind);
  f.column("events.i", events_, &Event::i);
  f.column("events.j", events_, &Event::j);
  for (Event& e : events_) f("events.sizes", e.sizes);
}

}  // namespace crumble::breaker
