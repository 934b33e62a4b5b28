#include "dryer/brownian_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/numerics/noise.hpp"
#include "common/numerics/simd.hpp"
// After it:
#include <hwy/contrib/math/math-inl.h>

namespace crumble::dryer {

namespace {

// Box & Muller for many numbers at once, one pair from u[k], v[k] each; count: of whole registers. The sine is taken
// from the cosine and the half of the circle.
void normals(const std::uint32_t* u, const std::uint32_t* v, std::size_t count, float* first, float* second) {
  using Tag = Simd<float>::Tag;
  constexpr hn::RebindToUnsigned<Tag> words;
  constexpr hn::RebindToSigned<Tag> whole;
  for (std::size_t k = 0; k < count; k += lanes) {
    const Simd<float> x = (Simd<float>(hn::ConvertTo(Tag(), hn::LoadU(words, u + k))) + 0.5f) * 0x1p-32f,
                      half_turns = hn::ConvertTo(Tag(), hn::BitCast(whole, hn::LoadU(words, v + k)));
    const Simd<float> angle = half_turns * (0x1p-31f * std::numbers::pi_v<float>),
                      r = sqrt(max(-2 * Simd<float>(hn::Log(Tag(), x.at[0])), 0)), c = hn::Cos(Tag(), angle.at[0]),
                      s = sqrt(max(1 - c * c, 0));
    (r * c).store(first + k);
    hn::StoreU(hn::CopySign((r * s).at[0], angle.at[0]), Tag(), second + k);
  }
}

// Index of a node: the depth at which an interval is filled, 0 for the whole, and the number of the increment.
std::uint64_t node(int depth, std::uint64_t interval) { return static_cast<std::uint64_t>(depth) << 58 | interval; }

}  // namespace

void BrownianPath::whole(std::span<const std::uint32_t> particle, std::uint64_t interval,
                         std::vector<float>& out) const {
  const std::size_t count = particle.size(), stride = padded(count);
  thread_local std::vector<std::uint32_t> id, words;
  thread_local std::vector<float> all;
  id.assign(stride, 0);
  std::copy(particle.begin(), particle.end(), id.begin());
  words.resize(4 * stride);
  all.resize(4 * stride);
  std::uint32_t* w = words.data();
  random_words(seed_, Purpose::brownian_path, id, node(0, interval), {w, w + stride, w + 2 * stride, w + 3 * stride});
  for (std::size_t k = 0; k < 4; k += 2)
    normals(w + k * stride, w + (k + 1) * stride, stride, &all[k * stride], &all[(k + 1) * stride]);
  out.resize(3 * count);
  for (std::size_t k = 0; k < 3; ++k) std::copy_n(all.data() + k * stride, count, out.data() + k * count);
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

}  // namespace crumble::dryer
