// The geometry that every hydrodynamic operator is built on.
#pragma once

#include <vector>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble {

// Positions and radii in one length unit.
struct Spheres {
  std::vector<Vector3> position;
  std::vector<double> radius;

  int size() const { return static_cast<int>(radius.size()); }
};

// The multipole formulas hold for spheres that do not overlap; small overlaps (the deformed contact of JKR) continue
// them analytically. Below this fraction of the sum of radii the mobility may lose positive definiteness: refused.
inline constexpr double closest_approach = 0.9;

// Throws std::invalid_argument, with the pair and its distance, on anything that the operators cannot take: sizes
// that differ, no sphere, a radius that is not positive, a number that is not finite, an overlap that is too deep.
void check(const Spheres& spheres);

double mean_radius(const Spheres& spheres);

Spheres scaled(const Spheres& spheres, double factor);

}  // namespace crumble
