// Pairs of spheres whose surfaces are close: what an analysis asks of positions alone, without a contact list.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble {

struct NearPair {
  std::int32_t i = 0, j = 0;  // i < j
  double gap = 0;             // surface to surface, m; negative where the spheres overlap
};

// All pairs with gap < fraction * pair_radius (a for equal spheres, 2 R* otherwise, as in the contact laws), sorted by
// (i, j). Lengths in m, fraction > -1. A k-d tree is asked around every sphere for those not larger than itself: O(N
// log N), also for very unequal radii.
std::vector<NearPair> near_pairs(std::span<const Vector3> position, std::span<const double> radius, double fraction);

}  // namespace crumble
