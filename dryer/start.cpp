#include "dryer/start.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <unordered_map>

#include "common/numerics/noise.hpp"

namespace crumble::dryer {

namespace {

// Free places by cells wide enough that only the 27 around a point can hold an overlap.
class Occupied {
 public:
  Occupied(const Agglomerate& state, double width) : state_(state), width_(width) {}

  bool overlaps(const Vector3& x, double a) const {
    const Eigen::Array3i c = cell(x);
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const auto found = members_.find(key(c + Eigen::Array3i(dx, dy, dz)));
          if (found == members_.end()) continue;
          for (const std::size_t q : found->second) {
            const double reach = a + state_.particles.radius[q];
            if ((x - state_.state.position[q]).squaredNorm() < reach * reach) return true;
          }
        }
    return false;
  }
  void add(std::size_t p) { members_[key(cell(state_.state.position[p]))].push_back(p); }

 private:
  Eigen::Array3i cell(const Vector3& x) const { return (x.array() / width_).floor().cast<int>(); }
  static std::uint64_t key(const Eigen::Array3i& c) {
    const auto part = [](int k) { return static_cast<std::uint64_t>(k + (1 << 20)); };
    return part(c[0]) << 42 | part(c[1]) << 21 | part(c[2]);
  }
  const Agglomerate& state_;
  double width_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> members_;
};

}  // namespace

Particles suspended_particles(const std::vector<double>& radius, double density) {
  Particles particles;
  particles.radius = radius;
  for (const double a : radius) {
    particles.mass.push_back(4.0 / 3.0 * std::numbers::pi * a * a * a * density);
    particles.id.push_back(static_cast<std::int64_t>(particles.id.size()));
  }
  particles.species.assign(radius.size(), 0);
  return particles;
}

Agglomerate random_suspension(const std::vector<double>& radius, double density, double R0, std::uint64_t seed) {
  constexpr std::uint64_t attempts = 100000;
  Agglomerate state{suspended_particles(radius, density), {}};
  Occupied occupied(state, 2 * *std::max_element(radius.begin(), radius.end()));
  for (std::size_t p = 0; p < radius.size(); ++p) {
    const double a = radius[p];
    std::uint64_t attempt = 0;
    for (;; ++attempt) {
      if (attempt == attempts || a > R0)
        throw std::runtime_error("no free place for particle " + std::to_string(p + 1) + " of " +
                                 std::to_string(radius.size()) + " in the droplet: too many or too large particles");
      const auto w = random_words(seed, Purpose::start_position, static_cast<std::uint32_t>(p), attempt);
      const Vector3 x = (R0 - a) * Vector3(2 * uniform(w[0]) - 1, 2 * uniform(w[1]) - 1, 2 * uniform(w[2]) - 1);
      if (x.norm() > R0 - a || occupied.overlaps(x, a)) continue;
      state.state.position.push_back(x);
      break;
    }
    occupied.add(p);
  }
  return state;
}

}  // namespace crumble::dryer
