#include "dryer/brownian_path.hpp"

#include <algorithm>
#include <array>
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
  // Three draws of four numbers serve two neighbouring nodes of six components. Rows 2k and 2k + 1 make two normal
  // numbers.
  void draw(std::size_t at, std::uint64_t seed, std::span<const std::uint32_t> particle, int level,
            std::uint64_t even) {
    constexpr std::size_t row_of[3][4] = {{0, 1, 2, 3}, {6, 7, 8, 9}, {4, 5, 10, 11}};
    const Purpose purpose[3] = {Purpose::brownian_path, Purpose::brownian_path, Purpose::brownian_path_rest};
    for (std::size_t d = 0; d < 3; ++d)
      random_words(seed, purpose[d], particle, node(level, even + (d == 1)),
                   {words.data() + row_of[d][0] * count + at, words.data() + row_of[d][1] * count + at,
                    words.data() + row_of[d][2] * count + at, words.data() + row_of[d][3] * count + at});
  }
  void transform() {
    for (std::size_t k = 0; k < 12; k += 2)
      normals(words.data() + k * count, words.data() + (k + 1) * count, count, xi.data() + k * count,
              xi.data() + (k + 1) * count);
  }
  const double* row(int component, bool odd) const {
    return xi.data() + static_cast<std::size_t>(component + (odd ? 6 : 0)) * count;
  }
};

}  // namespace

void BrownianPath::whole(std::span<const std::uint32_t> particle, std::uint64_t interval,
                         std::vector<double>& out) const {
  const std::size_t count = particle.size();
  thread_local std::vector<std::uint32_t> words;
  words.resize(4 * count);
  out.resize(4 * count);
  random_words(seed_, Purpose::brownian_path, particle, node(0, interval),
               {words.data(), words.data() + count, words.data() + 2 * count, words.data() + 3 * count});
  for (std::size_t k = 0; k < 4; k += 2)
    normals(words.data() + k * count, words.data() + (k + 1) * count, count, out.data() + k * count,
            out.data() + (k + 1) * count);
}

void BrownianPath::fill(std::span<const std::uint32_t> particle, std::uint64_t interval, int depth, std::size_t stride,
                        std::vector<double>& out) const {
  const std::size_t count = particle.size(), row = 6 * stride;
  out.resize(row << depth);
  thread_local Draws draws;

  draws.resize(count);
  draws.draw(0, seed_, particle, 0, interval & ~std::uint64_t{1});
  draws.transform();
  for (int k = 0; k < 6; ++k)
    std::copy_n(draws.row(k, interval & 1), count, out.data() + static_cast<std::size_t>(k) * stride);

  // Each increment has unit variance in units of its own interval: left = (W + xi)/sqrt(2), right = (W - xi)/sqrt(2).
  const double half = std::sqrt(0.5);
  const auto split = [&](std::size_t m, std::size_t pair, bool odd) {
    for (int k = 0; k < 6; ++k) {
      const std::size_t shift = static_cast<std::size_t>(k) * stride;
      const double *parent = out.data() + m * row + shift, *xi = draws.row(k, odd) + pair * count;
      double *left = out.data() + 2 * m * row + shift, *right = out.data() + (2 * m + 1) * row + shift;
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
    for (std::size_t pair = 0; pair < pairs; ++pair) draws.draw(pair * count, seed_, particle, level, first + 2 * pair);
    draws.transform();
    // From the last to the first: in place.
    for (std::size_t m = parents; m-- > 0;) split(m, m / 2, level == 1 ? interval & 1 : m & 1);
  }
}

}  // namespace crumble
