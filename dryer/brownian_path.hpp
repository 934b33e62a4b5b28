// The Brownian path of each particle, as a pure function of the seed: any interval of it can be asked for at any time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace crumble {

// A Wiener process in six components (three translations, three rotations) per particle, built top down: the increment
// over a whole interval is drawn first, and each halving splits it,
//
//   left = W/2 + (sqrt(T)/2) xi,   right = W - left,   xi standard normal                         (Brownian bridge)
//
// so a coarse step and the fine steps that fill it follow one and the same path. Every xi is keyed by (seed, purpose,
// particle, level, interval): nothing depends on the order of the calls, on threads, or on a restart.
// Source: Levy's construction; Philox of Salmon, Moraes, Dror & Shaw 2011.
class BrownianPath {
 public:
  explicit BrownianPath(std::uint64_t seed) : seed_(seed) {}

  // Translation over interval `interval` of the coarsest level: out[component * particle.size() + p], components 0-2,
  // of variance 1. (A fourth row is scratch.)
  void whole(std::span<const std::uint32_t> particle, std::uint64_t interval, std::vector<double>& out) const;

  // The 2^depth increments that fill the interval: out[(step * 6 + component) * stride + p], each of variance 1 (in
  // units of its own interval), components 0-2 translation, 3-5 rotation. stride >= particle.size().
  void fill(std::span<const std::uint32_t> particle, std::uint64_t interval, int depth, std::size_t stride,
            std::vector<double>& out) const;

 private:
  std::uint64_t seed_;
};

}  // namespace crumble
