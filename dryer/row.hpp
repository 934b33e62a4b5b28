// Three numbers in a register of four, or twice three in one of eight: what is kept of a particle or a bond where very
// many short steps are taken.
#pragma once

#include <cstring>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble {

using Quad = float __attribute__((vector_size(16)));
using DoubleQuad = double __attribute__((vector_size(32)));
// A translation and a rotation, or a force and a torque.
using Six = float __attribute__((vector_size(32)));

// Rows as they stand in memory; the fourth number is 0.
struct alignas(32) DoubleRow {
  using Register = DoubleQuad;
  double at[4] = {};
};
struct alignas(32) SixRow {
  using Register = Six;
  float at[8] = {};  // x, y, z, 0 of the translation, then of the rotation
};

template <class Row>
inline typename Row::Register load(const Row& row) {
  typename Row::Register value;
  std::memcpy(&value, row.at, sizeof(value));
  return value;
}
template <class Row>
inline void store(Row& row, typename Row::Register value) {
  std::memcpy(row.at, &value, sizeof(value));
}
inline Quad load_rotation(const SixRow& row) {
  Quad value;
  std::memcpy(&value, row.at + 4, sizeof(value));
  return value;
}

inline Quad in_single(DoubleQuad value) { return __builtin_convertvector(value, Quad); }
inline DoubleQuad in_double(Quad value) { return __builtin_convertvector(value, DoubleQuad); }

inline Quad all(float value) { return Quad{value, value, value, value}; }
inline Six six(Quad translation, Quad rotation) {
  return __builtin_shufflevector(translation, rotation, 0, 1, 2, 3, 4, 5, 6, 7);
}
inline Quad translation(Six value) { return __builtin_shufflevector(value, value, 0, 1, 2, 3); }
inline SixRow six_row(const Vector6& v) {
  SixRow row;
  for (int k = 0; k < 3; ++k) {
    row.at[k] = static_cast<float>(v[k]);
    row.at[4 + k] = static_cast<float>(v[3 + k]);
  }
  return row;
}
inline Vector6 vector(const SixRow& row) {
  return (Vector6() << row.at[0], row.at[1], row.at[2], row.at[4], row.at[5], row.at[6]).finished();
}
inline DoubleRow double_row(const Vector3& v) { return {{v[0], v[1], v[2], 0}}; }
inline Vector3 vector(const DoubleRow& row) { return {row.at[0], row.at[1], row.at[2]}; }

// In blocks of 16 that come from a transposition of registers, number l stands in row row_of(l).
constexpr std::size_t row_of(std::size_t l) { return l / 16 * 16 + l % 4 * 4 + l % 16 / 4; }

}  // namespace crumble
