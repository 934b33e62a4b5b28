// The Brownian path of each particle, as a pure function of the seed: any interval of it can be asked for at any time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace crumble::dryer {

// A Wiener process in six components (three translations, three rotations) per particle. The increment W over a whole
// interval is drawn first; the n that fill it are independent normal numbers xi under the condition that they sum to
// it,
//
//   w_k = xi_k - mean(xi) + W/sqrt(n)        (in units of their own standard deviations)
//
// so one long step and the short ones that fill it follow one and the same path. Every number is keyed by (seed,
// purpose, particle, depth, interval): nothing depends on the order of the calls, on threads, or on a restart. Source:
// Philox of Salmon, Moraes, Dror & Shaw 2011; conditional distribution of normal numbers under their sum.
class BrownianPath {
 public:
  explicit BrownianPath(std::uint64_t seed) : seed_(seed) {}

  // Translation over the whole interval: out[component * particle.size() + p], components 0-2,
  // of variance 1.
  void whole(std::span<const std::uint32_t> particle, std::uint64_t interval, std::vector<float>& out) const;

  // The 2^depth increments that fill the interval: out[(step * 6 + component) * stride + p], each of variance 1 (in
  // units of its own interval), components 0-2 translation, 3-5 rotation. stride >= particle.size(); what it leaves
  // beyond the particles is noise, too.
  void fill(std::span<const std::uint32_t> particle, std::uint64_t interval, int depth, std::size_t stride,
            std::vector<float>& out) const;

 private:
  std::uint64_t seed_;
};

}  // namespace crumble::dryer
