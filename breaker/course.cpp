#include "breaker/course.hpp"

#include <algorithm>
#include <limits>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"

namespace crumble::breaker {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

void look_fields(SavedFields f, std::vector<Look>& looks) {
  const auto column = [&](const char* name, auto member) { f.column(name, looks, member); };
  column("stress", &Look::stress);
  column("radius_of_gyration", &Look::radius_of_gyration);
  column("semi_axes", &Look::semi_axes);
  column("largest_fragment", &Look::largest_fragment);
  column("contacts", &Look::contacts);
  std::vector<NetworkState> network;
  for (const Look& look : looks) network.push_back(look.network);
  f.column("max_tension", network, &NetworkState::max_tension);
  f.column("max_use", network, &NetworkState::max_use);
  f.column("slipping", network, &NetworkState::slipping);
  f.column("twisting", network, &NetworkState::twisting);
  f.column("rolling", network, &NetworkState::rolling);
  for (std::size_t k = 0; k < looks.size(); ++k) looks[k].network = network[k];
}

void look_fields(SavedFields f, Look& look) {
  std::vector<Look> one{look};
  look_fields(f, one);
  look = one.front();
}

}  // namespace

Course::Course(const Particles& particles, const Pieces& pieces, double stress)
    : particles_(particles), severed_at_(particles.size(), never) {
  const std::vector<Contact>& contacts = pieces[0].frame().contacts;
  breakup_.contacts_initial = static_cast<std::int64_t>(contacts.size());
  breakup_.fragments = fragment_sizes(fragments(particles.size(), contacts));
  note_fragments(pieces[0], stress);
  observe(pieces, stress);
  breakup_.initial = breakup_.before = look_;
}

void Course::observe(const Pieces& pieces, double stress) {
  look_ = {};
  look_.stress = stress;
  const Piece* largest = &pieces[0];
  for (const Piece& piece : pieces) {
    const std::vector<Contact>& contacts = piece.frame().contacts;
    if (piece.member.size() > largest->member.size()) largest = &piece;
    look_.contacts += static_cast<std::int64_t>(contacts.size());
    look_.largest_fragment =
        std::max(look_.largest_fragment, fragment_sizes(fragments(piece.member.size(), contacts)).front());
    const NetworkState n = network_state(contacts, piece.integrator->network().laws());
    look_.network.max_tension = std::max(look_.network.max_tension, n.max_tension);
    look_.network.max_use = std::max(look_.network.max_use, n.max_use);
    look_.network.slipping += n.slipping;
    look_.network.twisting += n.twisting;
    look_.network.rolling += n.rolling;
  }
  const std::vector<double> radius = of_members(particles_.radius, largest->member),
                            mass = of_members(particles_.mass, largest->member);
  look_.radius_of_gyration = radius_of_gyration(largest->frame().position, mass);
  look_.semi_axes = semi_axes(largest->frame().position, radius, mass);
  max_use_ = std::max(max_use_, look_.network.max_use);
  if (!breakup_.severed && (past_.empty() || look_.stress > 1.001 * past_.back().stress)) past_.push_back(look_);
}

// In order of time: pieces that move one after the other tell of the same interval.
void Course::note(Event event) {
  const auto place = std::upper_bound(events_.begin(), events_.end(), event,
                                      [](const Event& a, const Event& b) { return a.time < b.time; });
  events_.insert(place, std::move(event));
}

bool Course::collect_events(Piece& piece) {
  bool ruptured = false;
  for (Event& e : piece.integrator->network().take_events()) {
    e.i = piece.member[e.i];
    e.j = piece.member[e.j];
    const bool at_limit = e.kind == EventKind::slip || e.kind == EventKind::twist || e.kind == EventKind::roll;
    if (e.kind == EventKind::rupture) ruptured = true;
    if (e.kind == EventKind::rupture && !breakup_.first_rupture) breakup_.first_rupture = e.stress;
    if (at_limit && !breakup_.first_limit) breakup_.first_limit = e.stress;
    note(std::move(e));
  }
  return ruptured;
}

void Course::note_fragments(const Piece& piece, double stress) {
  const auto label = fragments(piece.member.size(), piece.frame().contacts);
  for (std::size_t row = 0; row < label.size(); ++row) {
    double& severed = severed_at_[piece.member[row]];
    if (label[row] == 0)
      severed = never;
    else if (severed == never)
      severed = stress;
  }
}

void Course::lose(double time, double stress, const std::vector<std::int64_t>& sizes) {
  note({time, stress, EventKind::fragment_lost, -1, -1, sizes});
  breakup_.fragments = sizes;
}

// What it looked like shortly before: once the last avalanche has begun shape says nothing about the way to it.
void Course::look_back(double stress) {
  for (const Look& look : past_)
    if (look.stress <= 0.99 * stress) breakup_.before = look;
}

void Course::end_with_breakup(const Piece& kept, std::size_t particles_lost, double stress) {
  std::vector<bool> lost(particles_.size(), true);
  for (const std::int32_t p : kept.member) lost[p] = false;
  std::vector<double> severed;
  for (std::size_t p = 0; p < lost.size(); ++p)
    if (lost[p]) severed.push_back(severed_at_[p]);
  const auto decisive = severed.begin() + static_cast<std::ptrdiff_t>(particles_lost - 1);
  std::nth_element(severed.begin(), decisive, severed.end());
  breakup_.severed = *decisive;
  breakup_.lost = stress;
  look_back(*decisive);
}

void Course::end_unbroken() {
  if (!past_.empty()) breakup_.before = past_.back();
}

void Course::fields(SavedFields& f) {
  look_fields(f.in("look"), look_);
  look_fields(f.in("initial"), breakup_.initial);
  look_fields(f.in("before"), breakup_.before);
  f.size("past", past_);
  look_fields(f.in("past"), past_);
  f("first_limit", breakup_.first_limit);
  f("first_rupture", breakup_.first_rupture);
  f("critical_stress", breakup_.severed);
  f("lost_at", breakup_.lost);
  f("contacts_initial", breakup_.contacts_initial);
  f("fragments", breakup_.fragments);
  f("severed_at", severed_at_);
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
