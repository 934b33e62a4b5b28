// Configurations for the tests of the hydrodynamics, unit radii unless said: the classic small clusters of touching
// spheres and larger ones grown by a fixed rule.
#pragma once

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

}  // namespace crumble::testing
