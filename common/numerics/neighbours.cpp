#include "common/numerics/neighbours.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace crumble {

namespace {

bool close(const Eigen::Vector3d& x, const Eigen::Vector3d& y, double reach) {
  return (x - y).squaredNorm() < reach * reach;
}

std::size_t hash(const Eigen::Vector3i& c) {
  const auto mix = [](std::uint64_t h) {
    h ^= h >> 31;
    h *= 0x9e3779b97f4a7c15ULL;
    return h ^ (h >> 29);
  };
  return mix(mix(mix(static_cast<std::uint32_t>(c.x())) + static_cast<std::uint32_t>(c.y())) +
             static_cast<std::uint32_t>(c.z()));
}

}  // namespace

void NeighbourSearch::find(std::span<const Eigen::Vector3d> position, std::span<const double> radius, double gap,
                           std::vector<Pair>& pairs) {
  pairs.clear();
  const auto count = static_cast<std::int32_t>(position.size());
  if (count < 2) return;
  const double width = 2 * *std::max_element(radius.begin(), radius.end()) + gap;
  if (!(width > 0)) throw std::invalid_argument("neighbour search: radii and gap must be positive");

  cell_.resize(position.size());
  const std::size_t buckets = std::bit_ceil(2 * position.size());
  start_.assign(buckets + 1, 0);
  for (std::size_t p = 0; p < position.size(); ++p) {
    if (!(position[p].array().abs() < 1e9 * width).all())
      throw std::domain_error("neighbour search: particle " + std::to_string(p) + " has left the space (not finite?)");
    cell_[p] = (position[p] / width).array().floor().cast<int>();
    ++start_[(hash(cell_[p]) & (buckets - 1)) + 1];
  }
  for (std::size_t b = 0; b < buckets; ++b) start_[b + 1] += start_[b];
  member_.resize(position.size());
  for (std::int32_t p = count - 1; p >= 0; --p) member_[--start_[(hash(cell_[p]) & (buckets - 1)) + 1]] = p;
  // start_[b + 1] now begins bucket b.

  for (std::int32_t i = 0; i < count; ++i) {
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const Cell cell = cell_[i] + Cell(dx, dy, dz);
          const std::size_t b = hash(cell) & (buckets - 1);
          const std::int32_t end = b + 2 <= buckets ? start_[b + 2] : count;
          for (std::int32_t k = start_[b + 1]; k < end; ++k) {
            const std::int32_t j = member_[k];
            if (j > i && cell_[j] == cell && close(position[i], position[j], radius[i] + radius[j] + gap))
              pairs.push_back({i, j});
          }
        }
  }
  std::sort(pairs.begin(), pairs.end());
}

std::vector<Pair> neighbours_by_brute_force(std::span<const Eigen::Vector3d> position, std::span<const double> radius,
                                            double gap) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < position.size(); ++i)
    for (std::size_t j = i + 1; j < position.size(); ++j)
      if (close(position[i], position[j], radius[i] + radius[j] + gap))
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
  return pairs;
}

}  // namespace crumble
