#include "common/agglomerate/closing.hpp"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "common/contact/jkr.hpp"

namespace crumble {
namespace {

using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;
using Index = Eigen::Index;

struct Link {
  std::size_t i, j;
  double distance;  // wanted between the centres
};

std::string name(std::size_t i, std::size_t j) { return std::to_string(i) + "-" + std::to_string(j); }

// Residuals and unit normals of the links at given positions.
struct Residuals {
  VectorXd value;
  std::vector<Vector3> normal;
  double cost() const { return value.squaredNorm(); }
};

Residuals residuals(const std::vector<Link>& links, const std::vector<Vector3>& x) {
  Residuals r{VectorXd(static_cast<Index>(links.size())), {}};
  r.normal.reserve(links.size());
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Vector3 d = x[links[k].j] - x[links[k].i];
    const double length = d.norm();
    if (!(length > 0)) {
      throw std::invalid_argument("closing: particles " + name(links[k].i, links[k].j) +
                                  " have the same centre (or one that is not finite)");
    }
    r.value[static_cast<Index>(k)] = length - links[k].distance;
    r.normal.push_back(d / length);
  }
  return r;
}

// The links' matrix J J^T: 2 on the diagonal, +-n_k.n_l where two links share a particle.
class LinkMatrix {
 public:
  LinkMatrix(const std::vector<Link>& links, std::size_t particle_count) : links_(links), ends_(particle_count) {
    for (std::size_t k = 0; k < links.size(); ++k) {
      ends_[links[k].i].emplace_back(k, -1.0);
      ends_[links[k].j].emplace_back(k, +1.0);
    }
    solver_.cholmod().print = 0;
  }

  // y = -(J J^T + lambda)^-1 C; false if the factorisation broke down.
  bool solve(const Residuals& r, double lambda, VectorXd& y) {
    const Sparse matrix = assemble(r);
    if (!analysed_) solver_.analyzePattern(matrix);
    analysed_ = true;
    solver_.setShift(lambda);
    solver_.factorize(matrix);
    if (solver_.info() != Eigen::Success) return false;
    y = -solver_.solve(r.value);
    return y.allFinite();
  }

  // dx = J^T y
  std::vector<Vector3> moves(const Residuals& r, const VectorXd& y) const {
    std::vector<Vector3> dx(ends_.size(), Vector3::Zero());
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const Vector3 along = y[static_cast<Index>(k)] * r.normal[k];
      dx[links_[k].i] -= along;
      dx[links_[k].j] += along;
    }
    return dx;
  }

 private:
  Sparse assemble(const Residuals& r) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < links_.size(); ++k) entries.emplace_back(static_cast<int>(k), static_cast<int>(k), 2.0);
    for (const auto& at_particle : ends_) {
      for (std::size_t p = 0; p < at_particle.size(); ++p) {
        for (std::size_t q = 0; q < p; ++q) {
          const auto [k, sign_k] = at_particle[p];
          const auto [l, sign_l] = at_particle[q];
          entries.emplace_back(static_cast<int>(k), static_cast<int>(l),
                               sign_k * sign_l * r.normal[k].dot(r.normal[l]));
        }
      }
    }
    Sparse lower(static_cast<Index>(links_.size()), static_cast<Index>(links_.size()));
    lower.setFromTriplets(entries.begin(), entries.end());
    return lower;
  }

  const std::vector<Link>& links_;
  std::vector<std::vector<std::pair<std::size_t, double>>> ends_;  // links of each particle, with the sign of n there
  Eigen::CholmodSupernodalLLT<Sparse, Eigen::Lower> solver_;
  bool analysed_ = false;
};

// The largest change of a link, relative to its length. Its part across the link is what the linearisation neglects; a
// common motion of both ends, however long, is harmless.
double longest_change(const std::vector<Link>& links, const std::vector<Vector3>& dx) {
  double change = 0;
  for (const Link& link : links) change = std::max(change, (dx[link.j] - dx[link.i]).norm() / link.distance);
  return change;
}

struct Outcome {
  int iterations = 0;
  bool converged = true;
};

// Levenberg-Marquardt on dimensionless positions (lengths in a typical radius).
Outcome project(const std::vector<Link>& links, std::vector<Vector3>& x) {
  constexpr double largest_change = 0.1;  // linearised distances are then off by up to 0.5 %
  constexpr double least_damping = 1e-12, most_damping = 1e8;
  constexpr int most_iterations = 300;
  Outcome outcome;
  if (links.empty()) return outcome;
  double extent = 0;
  for (const Vector3& p : x) extent = std::max(extent, p.norm());
  const double round_off = 2 * std::numeric_limits<double>::epsilon() * (1 + extent);

  LinkMatrix matrix(links, x.size());
  Residuals r = residuals(links, x);
  double damping = 1e-6;
  VectorXd y;
  while (r.value.lpNorm<Eigen::Infinity>() > round_off) {
    if (damping > most_damping) break;  // no way down: the residual is at its least
    if (++outcome.iterations > most_iterations) {
      outcome.converged = false;
      break;
    }
    if (!matrix.solve(r, damping, y)) {
      damping *= 100;
      continue;
    }
    const std::vector<Vector3> dx = matrix.moves(r, y);
    if (longest_change(links, dx) > largest_change) {
      damping *= 10;
      continue;
    }
    std::vector<Vector3> next = x;
    for (std::size_t i = 0; i < x.size(); ++i) next[i] += dx[i];
    Residuals then = residuals(links, next);
    if (!(then.cost() < r.cost())) {
      damping *= 10;
      continue;
    }
    // Gauss-Newton steps gain several digits; a gain of 1e-9 means that only the irreducible part is left.
    const bool stalled = then.cost() > (1 - 1e-9) * r.cost();
    x = std::move(next);
    r = std::move(then);
    damping = std::max(damping / 100, least_damping);
    if (stalled) break;
  }
  return outcome;
}

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
        std::binary_search(frame.contacts.begin(), frame.contacts.end(), Contact{.i = pair.i, .j = pair.j},
                           [](const Contact& c, const Contact& d) { return std::tie(c.i, c.j) < std::tie(d.i, d.j); });
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
  std::sort(contacts.begin(), contacts.end(),
            [](const Contact& c, const Contact& d) { return std::tie(c.i, c.j) < std::tie(d.i, d.j); });
  std::vector<Jkr> laws = laws_of(particles, contacts, material);
  Scaled s = scaled(particles, frame.position);

  while (true) {
    std::vector<Link> links = links_of(particles, contacts, laws);
    for (Link& link : links) link.distance /= s.length;
    const Outcome outcome = project(links, s.position);
    closed.iterations += outcome.iterations;
    closed.converged = outcome.converged;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      closed.frame.position[i] = s.centre + s.length * s.position[i];
    }
    measure(particles, contacts, laws, closed.frame.position);
    const std::vector<bool> drop = most_open(contacts, laws, particles.size());
    if (std::find(drop.begin(), drop.end(), true) == drop.end()) break;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      if (drop[k]) {
        closed.lost.push_back({contacts[k].i, contacts[k].j, contacts[k].gap});
      } else {
        contacts[kept] = contacts[k];
        laws[kept++] = laws[k];
      }
    }
    contacts.resize(kept);
    laws.resize(kept);
  }

  summarise(closed, laws);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    closed.largest_move = std::max(closed.largest_move, (closed.frame.position[i] - frame.position[i]).norm());
  }
  for (NearPair& pair : closed.lost) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    pair.gap = (closed.frame.position[j] - closed.frame.position[i]).norm() - particles.radius[i] - particles.radius[j];
  }
  std::sort(closed.lost.begin(), closed.lost.end(),
            [](const NearPair& p, const NearPair& q) { return std::tie(p.i, p.j) < std::tie(q.i, q.j); });
  closed.unlisted = overlapping_strangers(particles, closed.frame);
  return closed;
}

}  // namespace crumble
