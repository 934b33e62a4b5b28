#include "common/agglomerate/near_pairs.hpp"

#include <algorithm>
#include <nanoflann.hpp>
#include <stdexcept>
#include <tuple>

#include "common/contact/material.hpp"

namespace crumble {
namespace {

struct PointCloud {
  std::span<const Vector3> point;
  std::size_t kdtree_get_point_count() const { return point.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return point[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointCloud>, PointCloud, 3>;

// The points within a distance, in the order of the tree: what nanoflann asks of a result set of one's own. Its
// radiusSearch would sort them too, and the types of its parameters and results changed their names with version 1.5.
struct WithinReach {
  using DistanceType = double;
  using IndexType = std::size_t;
  double reach_squared;
  std::vector<std::size_t> found;
  std::size_t size() const { return found.size(); }
  bool full() const { return true; }
  double worstDist() const { return reach_squared; }
  bool addPoint(double distance_squared, std::size_t i) {
    if (distance_squared < reach_squared) found.push_back(i);
    return true;
  }
  void sort() {}
};

// Each pair is met twice; the larger sphere keeps it, or the one of smaller index where both are equal.
bool keeps(std::span<const double> radius, std::size_t i, std::size_t j) {
  return radius[j] < radius[i] || (radius[j] == radius[i] && i < j);
}

}  // namespace

std::vector<NearPair> near_pairs(std::span<const Vector3> position, std::span<const double> radius, double fraction) {
  if (position.size() != radius.size()) throw std::invalid_argument("near_pairs: one radius a position is needed");
  std::vector<NearPair> pairs;
  if (position.size() < 2) return pairs;
  const PointCloud cloud{position};
  const Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  WithinReach within{};
  for (std::size_t i = 0; i < position.size(); ++i) {
    // a_j <= a_i gives a_i + a_j <= 2 a_i and pair_radius <= a_i; the hair on top covers rounding of the square.
    const double reach = (2 + std::max(fraction, 0.0)) * radius[i] * (1 + 1e-12);
    within.reach_squared = reach * reach;
    within.found.clear();
    tree.radiusSearchCustomCallback(position[i].data(), within);
    for (const std::size_t j : within.found) {
      if (!keeps(radius, i, j)) continue;
      const double gap = (position[j] - position[i]).norm() - radius[i] - radius[j];
      if (gap < fraction * pair_radius(radius[i], radius[j])) {
        const auto p = static_cast<std::int32_t>(i), q = static_cast<std::int32_t>(j);
        pairs.push_back({std::min(p, q), std::max(p, q), gap});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const NearPair& p, const NearPair& q) { return std::tie(p.i, p.j) < std::tie(q.i, q.j); });
  return pairs;
}

}  // namespace crumble
