// Positions and six-vectors of particles as they stand in memory, and the way between them and vector registers of as
// many particles or bonds as these hold.
#pragma once

#include <array>

#include "common/agglomerate/agglomerate.hpp"
#include "common/numerics/simd.hpp"

namespace crumble::dryer {

// From so many numbers on, several threads are worth it.
inline constexpr std::size_t many = 2000;

// The fourth number is 0.
struct alignas(32) Position {
  double at[4] = {};
};
// A translation and a rotation, or a force and a torque: x, y, z, 0 of each.
struct alignas(32) SixVector {
  float at[8] = {};
};
using Six = Simd<float, 8>;
using Quad = Simd<float, 4>;

inline Simd<double, 4> load(const Position& x) { return Simd<double, 4>::load(x.at); }
inline Six load(const SixVector& v) { return Six::load(v.at); }
inline void store(Position& x, const Simd<double, 4>& value) { value.store(x.at); }
inline void store(SixVector& v, const Six& value) { value.store(v.at); }

inline Quad in_single(const Simd<double, 4>& value) { return convert<float>(value); }
inline Simd<double, 4> in_double(const Quad& value) { return convert<double>(value); }
inline Six six(const Quad& translation, const Quad& rotation) { return joined(translation, rotation); }
inline Quad translation(const Six& value) { return lower_half(value); }
// From one to the other, the fourth number 0.
inline Quad difference(const Position& to, const Position& from) { return in_single(load(to) - load(from)); }

inline SixVector six_vector(const Vector6& v) {
  SixVector six;
  for (int k = 0; k < 3; ++k) {
    six.at[k] = static_cast<float>(v[k]);
    six.at[4 + k] = static_cast<float>(v[3 + k]);
  }
  return six;
}
inline Vector6 vector(const SixVector& v) {
  return (Vector6() << v.at[0], v.at[1], v.at[2], v.at[4], v.at[5], v.at[6]).finished();
}
inline Position position(const Vector3& x) { return {{x[0], x[1], x[2], 0}}; }
inline Vector3 vector(const Position& x) { return {x.at[0], x.at[1], x.at[2]}; }

// A vector a lane.
using Lane = Simd<float>;
struct LaneVector {
  Lane x, y, z;
};
HWY_INLINE LaneVector operator+(const LaneVector& a, const LaneVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE LaneVector operator-(const LaneVector& a, const LaneVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE LaneVector operator-(const LaneVector& a) { return {-a.x, -a.y, -a.z}; }
HWY_INLINE LaneVector operator*(const Lane& s, const LaneVector& a) { return {s * a.x, s * a.y, s * a.z}; }
HWY_INLINE Lane dot(const LaneVector& a, const LaneVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HWY_INLINE LaneVector cross(const LaneVector& a, const LaneVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Transpositions work within the quarters of a register (of four numbers; "blocks" in Highway): what belongs to lane l
// is in quarter l / 4 of register l % 4.
namespace transposition {

using Register = Lane::Register;
inline constexpr Lane::Tag tag{};
inline constexpr hn::Repartition<double, Lane::Tag> pairs{};

HWY_INLINE Register low_halves(Register p, Register q) {
  return hn::BitCast(tag, hn::InterleaveLower(pairs, hn::BitCast(pairs, p), hn::BitCast(pairs, q)));
}
HWY_INLINE Register high_halves(Register p, Register q) {
  return hn::BitCast(tag, hn::InterleaveUpper(pairs, hn::BitCast(pairs, p), hn::BitCast(pairs, q)));
}

// quarter(l) of lane first and of every fourth from there, one after the other.
template <class Tag, class Quarter>
HWY_INLINE hn::Vec<Tag> every_fourth(Tag to, std::size_t first, Quarter quarter) {
  if constexpr (hn::MaxLanes(Tag()) == 4) {
    return quarter(first).at[0];
  } else {
    const hn::Half<Tag> half;
    return hn::Combine(to, every_fourth(half, first + hn::MaxLanes(to) / 2, quarter),
                       every_fourth(half, first, quarter));
  }
}

}  // namespace transposition

// quarter(l): the three numbers of lane l and a fourth.
template <class Quarter>
HWY_INLINE LaneVector from_quarters(Quarter quarter) {
  using namespace transposition;
  const Register r0 = every_fourth(tag, 0, quarter), r1 = every_fourth(tag, 1, quarter),
                 r2 = every_fourth(tag, 2, quarter), r3 = every_fourth(tag, 3, quarter);
  const Register xy_low = hn::InterleaveLower(tag, r0, r1), xy_high = hn::InterleaveLower(tag, r2, r3);
  return {low_halves(xy_low, xy_high), high_halves(xy_low, xy_high),
          low_halves(hn::InterleaveUpper(tag, r0, r1), hn::InterleaveUpper(tag, r2, r3))};
}

using Quarters = std::array<Lane, 4>;
HWY_INLINE Quarters to_quarters(const LaneVector& v) {
  using namespace transposition;
  const Register x = v.x.at[0], y = v.y.at[0], z = v.z.at[0], none = hn::Zero(tag);
  const Register xy_low = hn::InterleaveLower(tag, x, y), xy_high = hn::InterleaveUpper(tag, x, y),
                 z_low = hn::InterleaveLower(tag, z, none), z_high = hn::InterleaveUpper(tag, z, none);
  return {low_halves(xy_low, z_low), high_halves(xy_low, z_low), low_halves(xy_high, z_high),
          high_halves(xy_high, z_high)};
}

// To as many six-vectors as there are lanes, that of lane l to place_of_lane(l): even quarters stand before odd ones.
HWY_INLINE void to_six_vectors(const Quarters& translation, const Quarters& rotation, SixVector* out) {
  float* to = out->at;
  for (std::size_t r = 0; r < 4; ++r) {
    const auto p = translation[r].at[0], q = rotation[r].at[0];
    if constexpr (lanes == 4) {
      hn::StoreU(p, Lane::Tag(), to + 8 * r);
      hn::StoreU(q, Lane::Tag(), to + 8 * r + 4);
    } else {
      hn::StoreU(hn::OddEvenBlocks(hn::SwapAdjacentBlocks(q), p), Lane::Tag(), to + 2 * lanes * r);
      hn::StoreU(hn::OddEvenBlocks(q, hn::SwapAdjacentBlocks(p)), Lane::Tag(), to + 2 * lanes * r + lanes);
    }
  }
}
constexpr std::size_t place_of_lane(std::size_t l) {
  constexpr std::size_t quarters = lanes / 4;
  const std::size_t quarter = l / 4;
  return l % 4 * quarters + quarter % 2 * (quarters / 2) + quarter / 2;
}
inline constexpr auto lane_at_place = [] {
  std::array<std::size_t, lanes> lane{};
  for (std::size_t l = 0; l < lanes; ++l) lane[place_of_lane(l)] = l;
  return lane;
}();

}  // namespace crumble::dryer
