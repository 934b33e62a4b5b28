#include "dryer/brownian_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/numerics/noise.hpp"

namespace crumble {

namespace {

// Box & Muller for many numbers at once, in a form that the compiler can vectorise: one pair from u[k], v[k] each. The
// sine is taken from the cosine and the half of the circle.
void normals(const std::uint32_t* u, const std::uint32_t* v, std::size_t count, double* first, double* second) {
#pragma omp simd
  for (std::size_t k = 0; k < count; ++k) {
    const double x = (u[k] + 0.5) * 0x1p-32, y = (v[k] + 0.5) * 0x1p-32;
    const double r = std::sqrt(-2 * std::log(x)), c = std::cos(2 * std::numbers::pi * y), s = std::sqrt(1 - c * c);
    first[k] = r * c;
    second[k] = y < 0.5 ? r * s : -r * s;
  }
}

// Index of a node: its level counted from the coarsest, and its interval at that level.
std::uint64_t node(int level, std::uint64_t interval) { return static_cast<std::uint64_t>(level) << 58 | interval; }

// Words and normal numbers of many nodes, one row a component: six rows for the even node of a pair, six for the odd.
struct Draws {
  std::vector<std::uint32_t> words;
  std::vector<double> xi;
  std::size_t count = 0;

  void resize(std::size_t n) {
    count = n;
    words.resize(12 * n);
    xi.resize(12 * n);
  }
  // Three draws of four numbers serve two neighbouring nodes of six components.
  void draw(std::size_t at, std::uint64_t seed, std::uint32_t particle, int level, std::uint64_t even) {
    const auto a = random_words(seed, Purpose::brownian_path, particle, node(level, even));
    const auto b = random_words(seed, Purpose::brownian_path, particle, node(level, even + 1));
    const auto c = random_words(seed, Purpose::brownian_torque, particle, node(level, even));
    // Rows 2k and 2k + 1 make two normal numbers.
    const std::uint32_t mixed[12] = {a[0], a[1], a[2], a[3], c[0], c[1], b[0], b[1], b[2], b[3], c[2], c[3]};
    for (std::size_t k = 0; k < 12; ++k) words[k * count + at] = mixed[k];
  }
  void transform() {
    for (std::size_t k = 0; k < 12; k += 2)
      normals(&words[k * count], &words[(k + 1) * count], count, &xi[k * count], &xi[(k + 1) * count]);
  }
  const double* row(int component, bool odd) const {
    return &xi[static_cast<std::size_t>(component + (odd ? 6 : 0)) * count];
  }
};

}  // namespace

void BrownianPath::whole(std::span<const std::uint32_t> particle, std::uint64_t interval,
                         std::vector<double>& out) const {
  const std::size_t count = particle.size();
  thread_local std::vector<std::uint32_t> words;
  words.resize(4 * count);
  out.resize(4 * count);
  for (std::size_t p = 0; p < count; ++p) {
    const auto a = random_words(seed_, Purpose::brownian_path, particle[p], node(0, interval));
    for (std::size_t k = 0; k < 4; ++k) words[k * count + p] = a[k];
  }
  for (std::size_t k = 0; k < 4; k += 2)
    normals(&words[k * count], &words[(k + 1) * count], count, &out[k * count], &out[(k + 1) * count]);
}

void BrownianPath::fill(std::span<const std::uint32_t> particle, std::uint64_t interval, int depth, std::size_t stride,
                        std::vector<double>& out) const {
  const std::size_t count = particle.size(), row = 6 * stride;
  out.resize(row << depth);
  thread_local Draws draws;

  draws.resize(count);
  for (std::size_t p = 0; p < count; ++p) draws.draw(p, seed_, particle[p], 0, interval & ~std::uint64_t{1});
  draws.transform();
  for (int k = 0; k < 6; ++k)
    std::copy_n(draws.row(k, interval & 1), count, &out[static_cast<std::size_t>(k) * stride]);

  // Each increment has unit variance in units of its own interval: left = (W + xi)/sqrt(2), right = (W - xi)/sqrt(2).
  const double half = std::sqrt(0.5);
  const auto split = [&](std::size_t m, std::size_t pair, bool odd) {
    for (int k = 0; k < 6; ++k) {
      const std::size_t shift = static_cast<std::size_t>(k) * stride;
      const double *parent = &out[m * row + shift], *xi = draws.row(k, odd) + pair * count;
      double *left = &out[2 * m * row + shift], *right = &out[(2 * m + 1) * row + shift];
      for (std::size_t p = 0; p < count; ++p) {
        const double W = parent[p], x = xi[p];
        right[p] = half * (W - x);
        left[p] = half * (W + x);
      }
    }
  };
  for (int level = 1; level <= depth; ++level) {
    // The parents of this level: of the one at level 1 the neighbour lies in another interval.
    const std::uint64_t first = (interval << (level - 1)) & ~std::uint64_t{1};
    const std::size_t parents = std::size_t{1} << (level - 1), pairs = std::max<std::size_t>(parents / 2, 1);
    draws.resize(pairs * count);
    for (std::size_t pair = 0; pair < pairs; ++pair)
      for (std::size_t p = 0; p < count; ++p) draws.draw(pair * count + p, seed_, particle[p], level, first + 2 * pair);
    draws.transform();
    // From the last to the first: in place.
    for (std::size_t m = parents; m-- > 0;) split(m, m / 2, level == 1 ? interval & 1 : m & 1);
  }
}

}  // namespace crumble
