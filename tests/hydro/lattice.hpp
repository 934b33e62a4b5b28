// A large compact cluster that costs nothing to make.
#pragma once

#include "clusters.hpp"

namespace crumble::testing {

// The innermost sites of a cubic lattice of touching spheres.
inline Spheres lattice_ball(int n) {
  std::vector<Vector3> x;
  const int half = static_cast<int>(std::ceil(std::cbrt(n)));
  for (int i = -half; i <= half; ++i)
    for (int j = -half; j <= half; ++j)
      for (int k = -half; k <= half; ++k) x.emplace_back(2 * i, 2 * j, 2 * k);
  std::stable_sort(x.begin(), x.end(),
                   [](const Vector3& a, const Vector3& b) { return a.squaredNorm() < b.squaredNorm(); });
  x.resize(static_cast<std::size_t>(n));
  return unit_spheres(x);
}

}  // namespace crumble::testing
