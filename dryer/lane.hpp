// Registers of 16 numbers, one a bond or particle, and the way from rows to them and back.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstring>
#include <vector>

#include "dryer/row.hpp"

namespace crumble {

// Arrays that are worked on in registers are filled up to whole ones.
inline constexpr std::size_t lanes = 16;
constexpr std::size_t padded(std::size_t count) { return (count + lanes - 1) / lanes * lanes; }

// From so many numbers on, several threads are worth it.
inline constexpr std::size_t many = 2000;

using Lane = Eigen::Array<float, lanes, 1>;

struct LaneVector {
  Lane x, y, z;
};
inline LaneVector operator+(const LaneVector& a, const LaneVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline LaneVector operator-(const LaneVector& a, const LaneVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline LaneVector operator*(const Lane& s, const LaneVector& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Lane dot(const LaneVector& a, const LaneVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline LaneVector cross(const LaneVector& a, const LaneVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Lane read(const float* from) { return Eigen::Map<const Lane>(from); }
inline void write(float* to, const Lane& value) { Eigen::Map<Lane>{to} = value; }

namespace in_lanes {

using Register = float __attribute__((vector_size(64)));
using Half = float __attribute__((vector_size(32)));

// Within quarters of a register.
inline Register interleave_low(const Register& p, const Register& q) {
  return __builtin_shufflevector(p, q, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
}
inline Register interleave_high(const Register& p, const Register& q) {
  return __builtin_shufflevector(p, q, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
}
inline Register low_halves(const Register& p, const Register& q) {
  return __builtin_shufflevector(p, q, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
}
inline Register high_halves(const Register& p, const Register& q) {
  return __builtin_shufflevector(p, q, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
}
inline Register from_lane(const Lane& value) {
  Register to;
  std::memcpy(&to, value.data(), sizeof(to));
  return to;
}
inline Lane to_lane(const Register& value) {
  Lane to;
  std::memcpy(to.data(), &value, sizeof(value));
  return to;
}

}  // namespace in_lanes

// Three numbers of each of 16 in quarters of four registers, number l in quarter row_of(l).
inline std::array<in_lanes::Register, 4> to_quarters(const LaneVector& v) {
  using namespace in_lanes;
  const Register x = from_lane(v.x), y = from_lane(v.y), z = from_lane(v.z), none{};
  const Register xy_low = interleave_low(x, y), xy_high = interleave_high(x, y), z_low = interleave_low(z, none),
                 z_high = interleave_high(z, none);
  return {low_halves(xy_low, z_low), high_halves(xy_low, z_low), low_halves(xy_high, z_high),
          high_halves(xy_high, z_high)};
}

// Twice three numbers of each of 16 to rows, number l to row row_of(l).
inline void to_rows(const LaneVector& translation, const LaneVector& rotation, SixRow* rows) {
  using in_lanes::Register;
  const auto first = to_quarters(translation), second = to_quarters(rotation);
#pragma GCC unroll 4
  for (std::size_t r = 0; r < 4; ++r) {
    const Register& p = first[r];
    const Register& q = second[r];
    const Register row[2] = {
        __builtin_shufflevector(p, q, 0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21, 22, 23),
        __builtin_shufflevector(p, q, 8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15, 28, 29, 30, 31)};
    std::memcpy(rows[4 * r].at, row, sizeof(row));
  }
}

// Sixteen rows to registers; row(l) is that of number l.
template <class RowOf>
inline __attribute__((always_inline)) LaneVector from_rows(RowOf row) {
  using namespace in_lanes;
  const auto every_fourth = [&](std::size_t l) __attribute__((always_inline)) {
    const Half low = __builtin_shufflevector(row(l), row(l + 4), 0, 1, 2, 3, 4, 5, 6, 7),
               high = __builtin_shufflevector(row(l + 8), row(l + 12), 0, 1, 2, 3, 4, 5, 6, 7);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  };
  const Register r0 = every_fourth(0), r1 = every_fourth(1), r2 = every_fourth(2), r3 = every_fourth(3);
  const Register xy_low = interleave_low(r0, r1), z_low = interleave_high(r0, r1), xy_high = interleave_low(r2, r3),
                 z_high = interleave_high(r2, r3);
  return {to_lane(low_halves(xy_low, xy_high)), to_lane(high_halves(xy_low, xy_high)),
          to_lane(low_halves(z_low, z_high))};
}

}  // namespace crumble
