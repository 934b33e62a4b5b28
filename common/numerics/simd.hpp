// Numbers in vector registers, with the operators of plain numbers, so that a law reads the same.
//
// The width is that of the registers of the level that is compiled for: 16, 8 or 4 numbers in single precision with
// AVX-512, AVX2, or SSE and NEON. Registers are those of Highway. GCC takes its own vectors apart that are wider than a
// register and shuffles them through the stack: with AVX2 a bond took 31 ns, now 12; with AVX-512 7.8 and 7.0 (Xeon
// Sapphire Rapids, November 2026). xsimd 8 of Debian 12 offers neither shuffles within quarters of a register nor the
// product of 32 to 64 bits that Philox wants.
#pragma once

// No level of x86-64 promises AES; without this Highway would take SSE for AVX2 and AVX-512.
#ifndef __AES__
#define HWY_DISABLE_PCLMUL_AES
#endif
// The length of their registers is not known here; such processors have NEON, too.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
// Nothing is chosen at run time, where Highway would ask for more than the level has (on arm64: cryptography).
#define HWY_COMPILE_ONLY_STATIC
#include <hwy/highway.h>
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
#error "Highway knows no vector registers at this level; on x86-64 compile with -march=x86-64-v2 or better"
#endif

#include <Eigen/Core>
#include <vector>

namespace crumble {

namespace hn = hwy::HWY_NAMESPACE;

// N numbers of type T: a register, or two where N are wider than that.
template <class T, std::size_t N = hn::MaxLanes(hn::ScalableTag<T>())>
class Simd {
 public:
  using Tag = hn::CappedTag<T, N>;
  using Register = hn::Vec<Tag>;
  static constexpr std::size_t size = N, in_register = hn::MaxLanes(Tag()), registers = N / in_register;
  static_assert(registers == 1 || registers == 2);

  HWY_INLINE Simd() : Simd(T{0}) {}
  HWY_INLINE Simd(T value) : Simd(hn::Set(Tag(), value)) {}
  HWY_INLINE Simd(Register value) {
    for (Register& part : at) part = value;
  }
  HWY_INLINE Simd(Register first, Register second) : at{first, second} {}

  static HWY_INLINE Simd load(const T* from) {
    return each([&](std::size_t k) { return hn::LoadU(Tag(), from + k * in_register); });
  }
  HWY_INLINE void store(T* to) const {
    hn::StoreU(at[0], Tag(), to);
    if constexpr (registers == 2) hn::StoreU(at[1], Tag(), to + in_register);
  }
  // 0, 1, 2, ...
  static HWY_INLINE Simd iota() {
    return each([](std::size_t k) { return hn::Iota(Tag(), static_cast<T>(k * in_register)); });
  }
  T operator[](std::size_t k) const { return hn::ExtractLane(at[k / in_register], k % in_register); }

  Simd& operator+=(const Simd& other) { return *this = *this + other; }

  // f(number of the register)
  template <class F>
  static HWY_INLINE Simd each(F f) {
    if constexpr (registers == 1)
      return Simd(f(0));
    else
      return Simd(f(0), f(1));
  }

  friend HWY_INLINE Simd operator+(const Simd& a, const Simd& b) {
    return each([&](std::size_t k) { return hn::Add(a.at[k], b.at[k]); });
  }
  friend HWY_INLINE Simd operator-(const Simd& a, const Simd& b) {
    return each([&](std::size_t k) { return hn::Sub(a.at[k], b.at[k]); });
  }
  friend HWY_INLINE Simd operator*(const Simd& a, const Simd& b) {
    return each([&](std::size_t k) { return hn::Mul(a.at[k], b.at[k]); });
  }
  friend HWY_INLINE Simd operator/(const Simd& a, const Simd& b) {
    return each([&](std::size_t k) { return hn::Div(a.at[k], b.at[k]); });
  }
  friend HWY_INLINE Simd operator-(const Simd& a) {
    return each([&](std::size_t k) { return hn::Neg(a.at[k]); });
  }
  friend HWY_INLINE Simd min(const Simd& a, const Simd& b) {
    return each([&](std::size_t k) { return hn::Min(a.at[k], b.at[k]); });
  }
  friend HWY_INLINE Simd max(const Simd& a, const Simd& b) {
    return each([&](std::size_t k) { return hn::Max(a.at[k], b.at[k]); });
  }
  friend HWY_INLINE Simd sqrt(const Simd& a) {
    return each([&](std::size_t k) { return hn::Sqrt(a.at[k]); });
  }
  // 1/sqrt(a) for a > 0: the processor's estimate, of 8 bits (NEON) to 14 (AVX-512), and steps of Newton, each of which
  // doubles them. Root and division take twice as long.
  friend HWY_INLINE Simd inverse_sqrt(const Simd& a) {
    Simd y = each([&](std::size_t k) { return hn::ApproximateReciprocalSqrt(a.at[k]); });
    for (int step = 0; step < (HWY_ARCH_X86 ? 1 : 2); ++step) y = y * (T(1.5) - T(0.5) * a * y * y);
    return y;
  }
  // a where x > y, else b.
  friend HWY_INLINE Simd where_greater(const Simd& x, const Simd& y, const Simd& a, const Simd& b) {
    return each([&](std::size_t k) { return hn::IfThenElse(hn::Gt(x.at[k], y.at[k]), a.at[k], b.at[k]); });
  }
  HWY_INLINE T sum() const {
    return hn::GetLane(hn::SumOfLanes(Tag(), registers == 1 ? at[0] : hn::Add(at[0], at[registers - 1])));
  }
  HWY_INLINE T least() const { return hn::GetLane(hn::MinOfLanes(Tag(), hn::Min(at[0], at[registers - 1]))); }
  HWY_INLINE T largest() const { return hn::GetLane(hn::MaxOfLanes(Tag(), hn::Max(at[0], at[registers - 1]))); }

  Register at[registers];
};

// The same of single numbers, for laws that are written for both.
inline float where_greater(float x, float y, float a, float b) { return x > y ? a : b; }

template <class T, std::size_t N>
HWY_INLINE Simd<T, 2 * N> joined(const Simd<T, N>& low, const Simd<T, N>& high) {
  using Both = Simd<T, 2 * N>;
  if constexpr (Both::registers == 1)
    return hn::Combine(typename Both::Tag(), high.at[0], low.at[0]);
  else
    return Both(low.at[0], high.at[0]);
}
template <class T, std::size_t N>
HWY_INLINE Simd<T, N / 2> lower_half(const Simd<T, N>& both) {
  if constexpr (Simd<T, N>::registers == 1)
    return hn::LowerHalf(typename Simd<T, N / 2>::Tag(), both.at[0]);
  else
    return both.at[0];
}

// Between single and double precision.
template <class To, class From, std::size_t N>
HWY_INLINE Simd<To, N> convert(const Simd<From, N>& value) {
  const typename Simd<To, N>::Tag to;
  if constexpr (Simd<From, N>::registers == 2) {
    const hn::Half<decltype(to)> half;
    return hn::Combine(to, hn::DemoteTo(half, value.at[1]), hn::DemoteTo(half, value.at[0]));
  } else if constexpr (Simd<To, N>::registers == 2) {
    const hn::Half<typename Simd<From, N>::Tag> half;
    return {hn::PromoteTo(to, hn::LowerHalf(half, value.at[0])), hn::PromoteTo(to, hn::UpperHalf(half, value.at[0]))};
  } else if constexpr (sizeof(To) < sizeof(From)) {
    return hn::DemoteTo(to, value.at[0]);
  } else {
    return hn::PromoteTo(to, value.at[0]);
  }
}

// Vectors begin where a register may be loaded in one piece.
template <class T>
using AlignedVector = std::vector<T, Eigen::aligned_allocator<T>>;

// Arrays that are worked on in registers of single precision are filled up to whole ones.
inline constexpr std::size_t lanes = Simd<float>::size;
constexpr std::size_t padded(std::size_t count) { return (count + lanes - 1) / lanes * lanes; }

}  // namespace crumble
