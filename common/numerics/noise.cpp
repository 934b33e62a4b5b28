#include "common/numerics/noise.hpp"

#include "common/numerics/simd.hpp"

namespace crumble {

namespace {

constexpr hn::ScalableTag<std::uint32_t> halves;
constexpr hn::Repartition<std::uint64_t, hn::ScalableTag<std::uint32_t>> places;
constexpr std::size_t width = hn::MaxLanes(halves);
using Words = hn::Vec<decltype(halves)>;

Words to_even(Words x) { return hn::BitCast(halves, hn::ShiftRight<32>(hn::BitCast(places, x))); }
Words to_odd(Words x) { return hn::BitCast(halves, hn::ShiftLeft<32>(hn::BitCast(places, x))); }

// Of the even words, 64 bits each.
Words product(Words x, std::uint32_t factor) { return hn::BitCast(halves, hn::MulEven(x, hn::Set(halves, factor))); }

// The ten rounds of Philox4x32 for every second word, the even ones; what the others hold does not matter.
HWY_INLINE void rounds(std::uint64_t seed, Words (&x)[4]) {
  std::uint32_t k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32);
  for (int round = 0; round < 10; ++round) {
    const Words m0 = product(x[0], PHILOX_M4x32_0), m1 = product(x[2], PHILOX_M4x32_1);
    x[0] = hn::Xor(hn::Xor(to_even(m1), x[1]), hn::Set(halves, k0));
    x[1] = m1;
    x[2] = hn::Xor(hn::Xor(to_even(m0), x[3]), hn::Set(halves, k1));
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
    const Words id = hn::LoadU(halves, &particle[p]);
    const Words low = hn::Set(halves, static_cast<std::uint32_t>(index)),
                high = hn::Set(halves, static_cast<std::uint32_t>(index >> 32)),
                use = hn::Set(halves, static_cast<std::uint32_t>(purpose));
    Words even[4] = {low, high, id, use}, odd[4] = {low, high, to_even(id), use};
    rounds(seed, even);
    rounds(seed, odd);
    for (std::size_t k = 0; k < 4; ++k) hn::StoreU(hn::OddEven(to_odd(odd[k]), even[k]), halves, out[k] + p);
  }
  for (; p < particle.size(); ++p) {
    const auto words = random_words(seed, purpose, particle[p], index);
    for (std::size_t k = 0; k < 4; ++k) out[k][p] = words[k];
  }
}

}  // namespace crumble
