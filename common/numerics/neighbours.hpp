// Pairs of spheres that are close to each other, by linked cells: O(N) in open space.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace crumble {

struct Pair {
  std::int32_t i, j;  // i < j
  auto operator<=>(const Pair&) const = default;
};

// Finds all pairs whose surfaces are closer than a given gap: |x_i - x_j| < a_i + a_j + gap. Cells are hashed, so
// memory grows with N and not with the volume. The result is sorted by (i, j), whatever the order of the search.
class NeighbourSearch {
 public:
  // position, radius: same length and unit as gap; cost grows with the number of pairs within 2 max(a) + gap.
  void find(std::span<const Eigen::Vector3d> position, std::span<const double> radius, double gap,
            std::vector<Pair>& pairs);

 private:
  using Cell = Eigen::Vector3i;
  std::vector<Cell> cell_;
  std::vector<std::int32_t> start_, member_;
};

// The slow, obvious search over all pairs: reference for the tests.
std::vector<Pair> neighbours_by_brute_force(std::span<const Eigen::Vector3d> position, std::span<const double> radius,
                                            double gap);

}  // namespace crumble
