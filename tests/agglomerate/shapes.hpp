// Configurations with known answers.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble::shapes {

inline Particles equal_spheres(std::size_t count, double radius) {
  Particles p;
  p.radius.assign(count, radius);
  p.mass.assign(count, 1300 * 4 * std::numbers::pi / 3 * radius * radius * radius);
  for (std::size_t i = 0; i < count; ++i) p.id.push_back(static_cast<std::int64_t>(i));
  p.species.assign(count, 0);
  return p;
}

inline Frame frame(std::vector<Vector3> position, std::vector<Contact> contacts = {}) {
  Frame f;
  f.position = std::move(position);
  f.contacts = std::move(contacts);
  return f;
}

inline std::vector<Vector3> chain(std::size_t count, double distance) {
  std::vector<Vector3> x;
  for (std::size_t i = 0; i < count; ++i) x.push_back(Vector3(distance * static_cast<double>(i), 0, 0));
  return x;
}

inline std::vector<Contact> chain_contacts(std::size_t count) {
  std::vector<Contact> contacts;
  for (std::int32_t i = 0; i + 1 < static_cast<std::int32_t>(count); ++i) contacts.push_back({.i = i, .j = i + 1});
  return contacts;
}

// Points spread evenly over the unit sphere (Fibonacci lattice).
inline std::vector<Vector3> shell(std::size_t count, double radius) {
  std::vector<Vector3> x;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t k = 0; k < count; ++k) {
    const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(count), s = std::sqrt(1 - z * z);
    const double phi = golden * static_cast<double>(k);
    x.push_back(radius * Vector3(s * std::cos(phi), s * std::sin(phi), z));
  }
  return x;
}

// A simple cubic lattice of the given spacing, cut by the ellipsoid with the given semi-axes.
inline std::vector<Vector3> lattice_ellipsoid(const Vector3& semi_axes, double spacing) {
  std::vector<Vector3> x;
  const auto reach = [&](double axis) { return static_cast<int>(axis / spacing) + 1; };
  for (int i = -reach(semi_axes[0]); i <= reach(semi_axes[0]); ++i)
    for (int j = -reach(semi_axes[1]); j <= reach(semi_axes[1]); ++j)
      for (int k = -reach(semi_axes[2]); k <= reach(semi_axes[2]); ++k) {
        const Vector3 p = spacing * Vector3(i, j, k);
        if (p.cwiseQuotient(semi_axes).squaredNorm() <= 1) x.push_back(p);
      }
  return x;
}

inline std::vector<Vector3> random_points(std::size_t count, double box, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> along(0, box);
  std::vector<Vector3> x;
  for (std::size_t i = 0; i < count; ++i) x.push_back({along(engine), along(engine), along(engine)});
  return x;
}

}  // namespace crumble::shapes
