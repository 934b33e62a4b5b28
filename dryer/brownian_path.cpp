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
template <class Number>
void normals(const std::uint32_t* u, const std::uint32_t* v, std::size_t count, Number* first, Number* second) {
  constexpr Number half = 0.5, unit = 0x1p-32, turn = 2 * std::numbers::pi_v<Number>;
#pragma omp simd
  for (std::size_t k = 0; k < count; ++k) {
    const Number x = (static_cast<Number>(u[k]) + half) * unit, y = (static_cast<Number>(v[k]) + half) * unit;
    const Number r = std::sqrt(-2 * std::log(x)), c = std::cos(turn * y), s = std::sqrt(std::max(1 - c * c, Number{0}));
    first[k] = r * c;
    second[k] = y < half ? r * s : -r * s;
  }
}

// Index of a node: the depth at which an interval is filled, 0 for the whole, and the number of the increment.
std::uint64_t node(int depth, std::uint64_t interval) { return static_cast<std::uint64_t>(depth) << 58 | interval; }

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
                        std::vector<float>& out) const {
  // Whole rows, so that nothing is left over for one number at a time.
  thread_local std::vector<std::uint32_t> id, words;
  thread_local std::vector<float> whole, sum;
  id.assign(stride, 0);
  std::copy(particle.begin(), particle.end(), id.begin());
  words.resize(12 * stride);
  whole.resize(8 * stride);
  const std::size_t row = 6 * stride, steps = std::size_t{1} << depth;
  out.resize(row << depth);

  const auto draw = [&](Purpose purpose, std::uint64_t index, std::size_t to) {
    std::uint32_t* w = words.data() + to * stride;
    random_words(seed_, purpose, id, index, {w, w + stride, w + 2 * stride, w + 3 * stride});
  };
  const auto pair_of_rows = [&](std::size_t from, float* to) {
    const std::uint32_t* w = words.data() + from * stride;
    normals(w, w + stride, stride, to, to + stride);
  };
  draw(Purpose::brownian_path, node(0, interval), 0);
  draw(Purpose::brownian_path_rest, node(0, interval), 4);
  for (std::size_t k = 0; k < 6; k += 2) pair_of_rows(k, whole.data() + k * stride);
  if (depth == 0) {
    std::copy_n(whole.data(), row, out.data());
    return;
  }

  // Three draws of four numbers serve two short steps of six components.
  sum.assign(row, 0);
  for (std::size_t m = 0; m < steps; m += 2) {
    const std::uint64_t even = (interval << depth) + m;
    draw(Purpose::brownian_path, node(depth, even), 0);
    draw(Purpose::brownian_path, node(depth, even + 1), 4);
    draw(Purpose::brownian_path_rest, node(depth, even), 8);
    float* to = out.data() + m * row;
    for (std::size_t k = 0; k < 12; k += 2) pair_of_rows(k, to + k * stride);
#pragma omp simd
    for (std::size_t k = 0; k < row; ++k) sum[k] += to[k] + to[row + k];
  }
  const float n = static_cast<float>(steps), root = std::sqrt(n);
  for (std::size_t k = 0; k < row; ++k) sum[k] = (whole[k] * root - sum[k]) / n;
  for (std::size_t m = 0; m < steps; ++m) {
    float* to = out.data() + m * row;
#pragma omp simd
    for (std::size_t k = 0; k < row; ++k) to[k] += sum[k];
  }
}

}  // namespace crumble
