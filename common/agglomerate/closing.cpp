#include "common/agglomerate/closing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "common/agglomerate/projection.hpp"
#include "common/contact/jkr.hpp"

namespace crumble {
namespace {

bool by_pair(const Contact& c, const Contact& d) { return std::tie(c.i, c.j) < std::tie(d.i, d.j); }

std::vector<Link> links_of(const Particles& particles, const std::vector<Contact>& contacts,
                           const std::vector<Jkr>& laws) {
  std::vector<Link> links;
  links.reserve(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto i = static_cast<std::size_t>(contacts[k].i), j = static_cast<std::size_t>(contacts[k].j);
    links.push_back({i, j, particles.radius[i] + particles.radius[j] + laws[k].equilibrium_gap});
  }
  return links;
}

void check(const Particles& particles, const Frame& frame) {
  if (frame.position.size() != particles.size()) {
    throw std::invalid_argument("closing: one radius a position is needed");
  }
  const auto count = static_cast<std::int64_t>(particles.size());
  std::vector<std::pair<std::int32_t, std::int32_t>> seen;
  for (const Contact& c : frame.contacts) {
    const std::string pair = std::to_string(c.i) + "-" + std::to_string(c.j);
    if (!(0 <= c.i && c.i < c.j && c.j < count)) {
      throw std::invalid_argument("closing: contact " + pair + " is not 0 <= i < j < " + std::to_string(count));
    }
    seen.emplace_back(c.i, c.j);
  }
  std::sort(seen.begin(), seen.end());
  const auto twice = std::adjacent_find(seen.begin(), seen.end());
  if (twice != seen.end()) {
    throw std::invalid_argument("closing: contact " + std::to_string(twice->first) + "-" +
                                std::to_string(twice->second) + " is listed twice");
  }
}

std::vector<Jkr> laws_of(const Particles& particles, const std::vector<Contact>& contacts, const Material& material) {
  std::map<double, Jkr> by_radius;  // few different pairs in most agglomerates
  std::vector<Jkr> laws;
  laws.reserve(contacts.size());
  for (const Contact& c : contacts) {
    const double a =
        pair_radius(particles.radius[static_cast<std::size_t>(c.i)], particles.radius[static_cast<std::size_t>(c.j)]);
    auto found = by_radius.find(a);
    if (found == by_radius.end()) found = by_radius.emplace(a, Jkr(material, a)).first;
    laws.push_back(found->second);
  }
  return laws;
}

// Positions around their centre in units of `length`, so that round-off is that of the agglomerate, not of its place.
struct Scaled {
  Vector3 centre = Vector3::Zero();
  double length = 1;
  std::vector<Vector3> position;
};

Scaled scaled(const Particles& particles, const std::vector<Vector3>& position) {
  Scaled s;
  s.length = *std::min_element(particles.radius.begin(), particles.radius.end());
  for (const Vector3& x : position) s.centre += x / static_cast<double>(position.size());
  for (const Vector3& x : position) s.position.push_back((x - s.centre) / s.length);
  return s;
}

// The contacts to give up in this round: open beyond the pull-off gap, not less so than any contact that shares a
// particle, and at least half as much as the worst of all. Slighter ones may close once these have gone.
std::vector<bool> most_open(const std::vector<Contact>& contacts, const std::vector<Jkr>& laws, std::size_t count) {
  std::vector<double> excess(contacts.size()), nearby(count, 0);
  double worst = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    excess[k] = contacts[k].gap / laws[k].pull_off_gap - 1;
    worst = std::max(worst, excess[k]);
    for (std::int32_t end : {contacts[k].i, contacts[k].j}) {
      nearby[static_cast<std::size_t>(end)] = std::max(nearby[static_cast<std::size_t>(end)], excess[k]);
    }
  }
  std::vector<bool> drop(contacts.size(), false);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    drop[k] = excess[k] > 0 && 2 * excess[k] >= worst && excess[k] >= nearby[static_cast<std::size_t>(contacts[k].i)] &&
              excess[k] >= nearby[static_cast<std::size_t>(contacts[k].j)];
  }
  return drop;
}

void measure(const Particles& particles, std::vector<Contact>& contacts, const std::vector<Jkr>& laws,
             const std::vector<Vector3>& position) {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& old = contacts[k];
    Contact c;
    c.i = old.i;
    c.j = old.j;
    c.born = old.born;
    const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
    const Vector3 d = position[j] - position[i];
    c.normal = d.normalized();
    c.gap = d.norm() - particles.radius[i] - particles.radius[j];
    c.normal_force = laws[k].tension(c.gap);
    contacts[k] = c;
  }
}

void measure_gaps(const Particles& particles, const std::vector<Vector3>& position, std::vector<NearPair>& pairs) {
  for (NearPair& pair : pairs) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    pair.gap = (position[j] - position[i]).norm() - particles.radius[i] - particles.radius[j];
  }
}

// Moves those of `most_open` from the contacts to the lost; false if there are none.
bool drop_most_open(const Particles& particles, std::vector<Contact>& contacts, std::vector<Jkr>& laws,
                    std::vector<NearPair>& lost) {
  const std::vector<bool> drop = most_open(contacts, laws, particles.size());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (drop[k]) {
      lost.push_back({contacts[k].i, contacts[k].j, contacts[k].gap});
    } else {
      contacts[kept] = contacts[k];
      laws[kept++] = laws[k];
    }
  }
  const bool any = kept < contacts.size();
  contacts.resize(kept);
  laws.resize(kept);
  return any;
}

// A pair that was dropped and overlaps after all, because others were dropped later, is a contact again.
bool readmit_touching(std::vector<Contact>& contacts, std::vector<NearPair>& lost) {
  const auto touching = std::partition(lost.begin(), lost.end(), [](const NearPair& p) { return p.gap >= 0; });
  if (touching == lost.end()) return false;
  for (auto pair = touching; pair != lost.end(); ++pair) contacts.push_back({.i = pair->i, .j = pair->j});
  lost.erase(touching, lost.end());
  std::sort(contacts.begin(), contacts.end(), by_pair);
  return true;
}

void summarise(Closed& closed, const std::vector<Jkr>& laws) {
  double squares = 0, tensions = 0;
  const std::vector<Contact>& contacts = closed.frame.contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double residual = contacts[k].gap - laws[k].equilibrium_gap;
    const double tension = contacts[k].normal_force / laws[k].pull_off_force;
    squares += residual * residual;
    tensions += tension * tension;
    closed.residual_max = std::max(closed.residual_max, std::abs(residual));
    closed.tension_max = std::max(closed.tension_max, tension);
    closed.compression_max = std::max(closed.compression_max, -tension);
  }
  if (contacts.empty()) return;
  closed.residual_rms = std::sqrt(squares / static_cast<double>(contacts.size()));
  closed.tension_rms = std::sqrt(tensions / static_cast<double>(contacts.size()));
}

std::vector<NearPair> overlapping_strangers(const Particles& particles, const Frame& frame) {
  std::vector<NearPair> strangers;
  for (const NearPair& pair : near_pairs(frame.position, particles.radius, 0)) {
    const bool listed =
        std::binary_search(frame.contacts.begin(), frame.contacts.end(), Contact{.i = pair.i, .j = pair.j}, by_pair);
    if (!listed) strangers.push_back(pair);
  }
  return strangers;
}

}  // namespace

Closed close_contacts(const Particles& particles, const Frame& frame, const Material& material) {
  check(particles, frame);
  Closed closed;
  closed.frame.step = frame.step;
  closed.frame.time = frame.time;
  closed.frame.position = frame.position;
  closed.frame.orientation = frame.orientation;
  closed.converged = true;
  if (particles.size() == 0) return closed;
  std::vector<Contact>& contacts = closed.frame.contacts;
  contacts = frame.contacts;
  std::sort(contacts.begin(), contacts.end(), by_pair);
  std::vector<Jkr> laws = laws_of(particles, contacts, material);
  Scaled s = scaled(particles, frame.position);

  for (bool second_chance = true;;) {
    std::vector<Link> links = links_of(particles, contacts, laws);
    for (Link& link : links) link.distance /= s.length;
    const Projected outcome = project(links, s.position);
    closed.iterations += outcome.iterations;
    closed.converged = outcome.converged;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      closed.frame.position[i] = s.centre + s.length * s.position[i];
    }
    measure(particles, contacts, laws, closed.frame.position);
    measure_gaps(particles, closed.frame.position, closed.lost);
    if (drop_most_open(particles, contacts, laws, closed.lost)) continue;
    if (!second_chance || !readmit_touching(contacts, closed.lost)) break;
    second_chance = false;
    laws = laws_of(particles, contacts, material);
  }

  summarise(closed, laws);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    closed.largest_move = std::max(closed.largest_move, (closed.frame.position[i] - frame.position[i]).norm());
  }
  std::sort(closed.lost.begin(), closed.lost.end(),
            [](const NearPair& p, const NearPair& q) { return std::tie(p.i, p.j) < std::tie(q.i, q.j); });
  closed.unlisted = overlapping_strangers(particles, closed.frame);
  return closed;
}

Closed close_all_contacts(const Particles& particles, const Frame& frame, const Material& material, std::size_t& made) {
  Closed closed = close_contacts(particles, frame, material);
  made = 0;
  for (int round = 0; round < 10 && closed.converged && !closed.unlisted.empty(); ++round) {
    Frame longer = closed.frame;
    for (const NearPair& pair : closed.unlisted) longer.contacts.push_back({.i = pair.i, .j = pair.j});
    made += closed.unlisted.size();
    Closed next = close_contacts(particles, longer, material);
    next.iterations += closed.iterations;
    next.lost.insert(next.lost.end(), closed.lost.begin(), closed.lost.end());
    closed = std::move(next);
  }
  closed.largest_move = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    closed.largest_move = std::max(closed.largest_move, (closed.frame.position[i] - frame.position[i]).norm());
  return closed;
}

}  // namespace crumble
