// Configurations for the tests of the hydrodynamics, unit radii unless said: the classic small clusters of touching
// spheres and larger ones grown by a fixed rule.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "common/hydro/spheres.hpp"

namespace crumble::testing {

inline Spheres unit_spheres(std::vector<Vector3> position) {
  Spheres s;
  s.radius.assign(position.size(), 1.0);
  s.position = std::move(position);
  return s;
}

// Along x, neighbours at the given distance, centred at the origin.
inline Spheres chain(int n, double distance = 2) {
  std::vector<Vector3> x;
  for (int i = 0; i < n; ++i) x.emplace_back((i - 0.5 * (n - 1)) * distance, 0, 0);
  return unit_spheres(x);
}

inline Spheres triangle() {  // in the plane z = 0
  const double h = std::sqrt(3.0);
  return unit_spheres({{-1, -h / 3, 0}, {1, -h / 3, 0}, {0, 2 * h / 3, 0}});
}

inline Spheres tetrahedron() {
  const double c = std::sqrt(0.5);
  return unit_spheres({{c, c, c}, {c, -c, -c}, {-c, c, -c}, {-c, -c, c}});
}

inline Spheres octahedron() {
  const double c = std::sqrt(2.0);
  return unit_spheres({{c, 0, 0}, {-c, 0, 0}, {0, c, 0}, {0, -c, 0}, {0, 0, c}, {0, 0, -c}});
}

// n spheres drawn one after another in a cube of the given side, none closer than `distance` times the sum of radii.
inline Spheres random_spheres(int n, double side, unsigned seed, double distance = 1, double radius_ratio = 1) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  Spheres s;
  while (s.size() < n) {
    const Vector3 x(side * uniform(), side * uniform(), side * uniform());
    const double a = 1 + (radius_ratio - 1) * uniform();
    bool free = true;
    for (int i = 0; i < s.size(); ++i) free = free && (x - s.position[i]).norm() >= distance * (a + s.radius[i]);
    if (!free) continue;
    s.position.push_back(x);
    s.radius.push_back(a);
  }
  return s;
}

// A connected cluster of unit spheres: every new one touches one, two or three of those present and overlaps none. Of
// `choices` free places at a distance from the centre between `inner` and `outer`, the innermost is taken.
struct Growth {
  int n = 85;
  double inner = 0, outer = 1e9;
  int choices = 10;
  double single = 0;  // fraction of spheres that touch one sphere only (two otherwise)
  unsigned seed = 1;
};

inline Spheres grown(const Growth& g) {
  std::mt19937_64 engine(g.seed);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  const auto direction = [&] {
    const double z = 2 * uniform() - 1, phi = 2 * 3.14159265358979323846 * uniform(), s = std::sqrt(1 - z * z);
    return Vector3(s * std::cos(phi), s * std::sin(phi), z);
  };
  std::vector<Vector3> x = {Vector3(std::max(g.inner, 0.0) + 1e-9, 0, 0)};
  while (static_cast<int>(x.size()) < g.n) {
    std::vector<Vector3> places;
    const bool one = x.size() < 2 || uniform() < g.single;
    for (int attempts = 0; static_cast<int>(places.size()) < g.choices && attempts < 100000; ++attempts) {
      const auto pick = [&] { return x[static_cast<std::size_t>(uniform() * static_cast<double>(x.size()))]; };
      const Vector3 first = pick(), second = pick(), axis = second - first;
      Vector3 place = first + 2 * direction();
      if (!one) {
        const double half = axis.norm() / 2;
        if (half < 0.5 || half > 1.99) continue;
        Vector3 sideways = direction();
        sideways -= axis * (axis.dot(sideways) / axis.squaredNorm());
        place = first + axis / 2 + sideways.normalized() * std::sqrt(4 - half * half);
      }
      if (place.norm() < g.inner || place.norm() > g.outer) continue;
      bool free = true;
      for (const Vector3& other : x) free = free && (place - other).norm() > 2 * (1 - 1e-9);
      if (free) places.push_back(place);
    }
    if (places.empty()) continue;
    x.push_back(*std::min_element(places.begin(), places.end(),
                                  [](const Vector3& a, const Vector3& b) { return a.norm() < b.norm(); }));
  }
  return unit_spheres(x);
}

// Some load or motion on every sphere, the same in every run.
inline Eigen::VectorXd wave(Eigen::Index n) {
  Eigen::VectorXd v(n);
  for (Eigen::Index k = 0; k < n; ++k) v[k] = std::sin(1.0 + 1.7 * static_cast<double>(k));
  return v;
}

// As the dried agglomerates of the paper in number and coordination: about 4.1 and 3.3.
inline Spheres compact_85(unsigned seed = 1) { return grown({85, 0, 1e9, 12, 0, seed}); }
inline Spheres hollow_115(unsigned seed = 1) { return grown({115, 3.5, 7, 1, 0.35, seed}); }

}  // namespace crumble::testing
