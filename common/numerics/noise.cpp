#include "common/numerics/noise.hpp"

#include "common/numerics/simd.hpp"

namespace crumble {

namespace {

constexpr hn::ScalableTag<std::uint32_t> tag;
constexpr hn::Repartition<std::uint64_t, hn::ScalableTag<std::uint32_t>> wide;
constexpr std::size_t width = hn::MaxLanes(tag);
using Words = hn::Vec<decltype(tag)>;

Words to_even(Words x) { return hn::BitCast(tag, hn::ShiftRight<32>(hn::BitCast(wide, x))); }
Words to_odd(Words x) { return hn::BitCast(tag, hn::ShiftLeft<32>(hn::BitCast(wide, x))); }

// Of the even words, 64 bits each.
Words product(Words x, std::uint32_t factor) { return hn::BitCast(tag, hn::MulEven(x, hn::Set(tag, factor))); }

// The ten rounds of Philox4x32 for every second word, the even ones; what the others hold does not matter. Of two sets
// at once: while the products of one are under way, those of the other begin.
HWY_INLINE void rounds(std::uint64_t seed, Words (&a)[4], Words (&b)[4]) {
  std::uint32_t k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32);
  for (int round = 0; round < 10; ++round) {
    for (auto* x : {&a, &b}) {
      auto& [x0, x1, x2, x3] = *x;
      const Words m0 = product(x0, PHILOX_M4x32_0), m1 = product(x2, PHILOX_M4x32_1);
      x0 = hn::Xor(hn::Xor(to_even(m1), x1), hn::Set(tag, k0));
      x1 = m1;
      x2 = hn::Xor(hn::Xor(to_even(m0), x3), hn::Set(tag, k1));
      x3 = m0;
    }
    k0 += PHILOX_W32_0;
    k1 += PHILOX_W32_1;
  }
}

}  // namespace

void random_words(std::uint64_t seed, Purpose purpose, std::span<const std::uint32_t> particle, std::uint64_t index,
                  const std::array<std::uint32_t*, 4>& out) {
  std::size_t p = 0;
  for (; p + width <= particle.size(); p += width) {
    const Words id = hn::LoadU(tag, &particle[p]);
    const Words low = hn::Set(tag, static_cast<std::uint32_t>(index)),
                high = hn::Set(tag, static_cast<std::uint32_t>(index >> 32)),
                use = hn::Set(tag, static_cast<std::uint32_t>(purpose));
    Words even[4] = {low, high, id, use}, odd[4] = {low, high, to_even(id), use};
    rounds(seed, even, odd);
    for (std::size_t k = 0; k < 4; ++k) hn::StoreU(hn::OddEven(to_odd(odd[k]), even[k]), tag, out[k] + p);
  }
  for (; p < particle.size(); ++p) {
    const auto words = random_words(seed, purpose, particle[p], index);
    for (std::size_t k = 0; k < 4; ++k) out[k][p] = words[k];
  }
}

}  // namespace crumble
