// Small agglomerates at 100 nm, contacts free of force, and runs that break them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "breaker/explicit_euler.hpp"
#include "breaker/implicit.hpp"
#include "common/agglomerate/closing.hpp"
#include "common/agglomerate/fragments.hpp"

namespace crumble::breaker::testing {

inline constexpr double a = 1e-7;  // m

// Spheres at the given centres (in a), all pairs closer than 2.01 a bonded and closed.
inline Agglomerate cluster(const std::vector<Vector3>& centres) {
  Agglomerate g;
  for (std::size_t p = 0; p < centres.size(); ++p) {
    g.particles.radius.push_back(a);
    g.particles.mass.push_back(1);
    g.particles.id.push_back(static_cast<std::int64_t>(p));
    g.particles.species.push_back(0);
    g.state.position.push_back(a * centres[p]);
    for (std::size_t q = 0; q < p; ++q)
      if ((centres[p] - centres[q]).norm() < 2.01) {
        Contact c;
        c.i = static_cast<std::int32_t>(q);
        c.j = static_cast<std::int32_t>(p);
        g.state.contacts.push_back(c);
      }
  }
  std::sort(g.state.contacts.begin(), g.state.contacts.end(),
            [](const Contact& x, const Contact& y) { return std::pair(x.i, x.j) < std::pair(y.i, y.j); });
  g.state = close_contacts(g.particles, g.state, Material{}).frame;
  g.state.orientation.assign(centres.size(), Quaternion::Identity());
  return g;
}

inline std::vector<Vector3> chain(int n) {
  std::vector<Vector3> x;
  for (int k = 0; k < n; ++k) x.emplace_back(2.0 * k - (n - 1), 0, 0);
  return x;
}

// Five spheres, each bond turned by 30 degrees against the one before: the flow must bend it.
inline std::vector<Vector3> bent_chain() {
  std::vector<Vector3> x{Vector3::Zero()};
  for (int k = 0; k < 4; ++k) {
    const double angle = (k - 1.5) * std::numbers::pi / 6;
    x.push_back(x.back() + 2 * Vector3(std::cos(angle), 0.3 * std::sin(2 * angle), std::sin(angle)).normalized());
  }
  return x;
}

inline std::vector<Vector3> ring() {
  std::vector<Vector3> x;
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3 + 0.2;
    x.emplace_back(2 * std::cos(angle), 0, 2 * std::sin(angle));
  }
  return x;
}

inline std::vector<Vector3> tetrahedron() {
  const double h = std::sqrt(0.5);
  return {{h, h, h}, {h, -h, -h}, {-h, h, -h}, {-h, -h, h}};
}

inline BreakupModel elongation(Rung rung) {
  BreakupModel model;
  model.hydro.rung = rung;
  model.hydro.gap_floor = 1e-3;
  model.gradient = planar_elongation(1).gradient;
  return model;
}

// Stress at which the first fragment comes off, 0 if none does up to `largest`.
inline double critical_stress(Integrator& run, const Protocol& protocol, double largest = 1e5) {
  const std::size_t n = run.frame().position.size();
  while (true) {
    const bool changed = run.step(protocol.stage_end(run.frame().time));
    const double stress = protocol.stress_before(run.frame().time);
    if (changed && fragment_sizes(fragments(n, run.frame().contacts)).size() > 1) return stress;
    if (stress > largest) return 0;
  }
}

// Distances of the surfaces of the listed pairs, m.
inline std::vector<double> gaps(const Frame& frame, const std::vector<Contact>& pairs) {
  std::vector<double> h;
  for (const Contact& c : pairs) h.push_back((frame.position[c.j] - frame.position[c.i]).norm() - 2 * a);
  return h;
}

struct Outcome {
  std::vector<std::vector<double>> gap;  // of the contacts at the start, at each of the wanted stresses
  double critical = 0;                   // Pa
  std::int64_t steps = 0;
};

// Follows a ramp from 0 at `rate` to the stresses in turn, then to the first fragment.
inline Outcome follow(Integrator& run, const Protocol& protocol, const std::vector<double>& stresses, double rate) {
  Outcome course;
  const std::vector<Contact> pairs = run.frame().contacts;
  for (const double stress : stresses) {
    while (run.frame().time < stress / rate) run.step(stress / rate);
    course.gap.push_back(gaps(run.frame(), pairs));
  }
  course.critical = critical_stress(run, protocol);
  course.steps = run.statistics().steps;
  return course;
}

}  // namespace crumble::breaker::testing
