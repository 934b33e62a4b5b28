#include "common/numerics/noise.hpp"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

#include <cstring>

namespace crumble {

namespace {

// Eight words, each in the lower half of its place; what the upper half holds does not matter.
using Words = std::uint64_t __attribute__((vector_size(64)));
using Packed = std::uint32_t __attribute__((vector_size(32)));
constexpr std::size_t width = 8;

Words all(std::uint32_t word) { return Words{} + word; }

// The compiler takes the product of whole places, three times the work, unless it is told that halves will do.
Words product(Words a, Words b) {
#ifdef __AVX512F__
  return reinterpret_cast<Words>(_mm512_mul_epu32(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b)));
#else
  return (a & 0xffffffff) * (b & 0xffffffff);
#endif
}

// The ten rounds of Philox4x32.
inline void rounds(std::uint64_t seed, Words (&x)[4]) {
  std::uint32_t k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32);
#pragma GCC unroll 10
  for (int round = 0; round < 10; ++round) {
    const Words m0 = product(x[0], all(PHILOX_M4x32_0)), m1 = product(x[2], all(PHILOX_M4x32_1));
    x[0] = (m1 >> 32) ^ x[1] ^ all(k0);
    x[1] = m1;
    x[2] = (m0 >> 32) ^ x[3] ^ all(k1);
    x[3] = m0;
    k0 += PHILOX_W32_0;
    k1 += PHILOX_W32_1;
  }
}

}  // namespace

void random_words(std::uint64_t seed, Purpose purpose, std::span<const std::uint32_t> particle, std::uint64_t index,
                  const std::array<std::uint32_t*, 4>& out) {
  std::size_t p = 0;
  for (; p + width <= particle.size(); p += width) {
    Packed id;
    std::memcpy(&id, &particle[p], sizeof(id));
    Words x[4] = {all(static_cast<std::uint32_t>(index)), all(static_cast<std::uint32_t>(index >> 32)),
                  __builtin_convertvector(id, Words), all(static_cast<std::uint32_t>(purpose))};
    rounds(seed, x);
    for (std::size_t k = 0; k < 4; ++k) {
      const Packed words = __builtin_convertvector(x[k], Packed);
      std::memcpy(out[k] + p, &words, sizeof(words));
    }
  }
  for (; p < particle.size(); ++p) {
    const auto words = random_words(seed, purpose, particle[p], index);
    for (std::size_t k = 0; k < 4; ++k) out[k][p] = words[k];
  }
}

}  // namespace crumble
