// Three numbers in a register of four: what is kept of a particle or a bond where very many short steps are taken.
#pragma once

#include <cstring>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble {

using Quad = float __attribute__((vector_size(16)));
using DoubleQuad = double __attribute__((vector_size(32)));

// Rows as they stand in memory; the fourth number is 0.
struct alignas(16) Row {
  float at[4] = {};
};
struct alignas(32) DoubleRow {
  double at[4] = {};
};

inline Quad load(const Row& row) {
  Quad value;
  std::memcpy(&value, row.at, sizeof(value));
  return value;
}
inline void store(Row& row, Quad value) { std::memcpy(row.at, &value, sizeof(value)); }
inline DoubleQuad load(const DoubleRow& row) {
  DoubleQuad value;
  std::memcpy(&value, row.at, sizeof(value));
  return value;
}
inline void store(DoubleRow& row, DoubleQuad value) { std::memcpy(row.at, &value, sizeof(value)); }

inline Quad in_single(DoubleQuad value) { return __builtin_convertvector(value, Quad); }
inline DoubleQuad in_double(Quad value) { return __builtin_convertvector(value, DoubleQuad); }

inline Quad all(float value) { return Quad{value, value, value, value}; }
inline Row row(const Vector3& v) {
  return {{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), 0}};
}
inline Vector3 vector(const Row& row) { return {row.at[0], row.at[1], row.at[2]}; }
inline DoubleRow double_row(const Vector3& v) { return {{v[0], v[1], v[2], 0}}; }
inline Vector3 vector(const DoubleRow& row) { return {row.at[0], row.at[1], row.at[2]}; }

// In blocks of 16 that come from a transposition of registers, number l stands in row row_of(l).
constexpr std::size_t row_of(std::size_t l) { return l / 16 * 16 + l % 4 * 4 + l % 16 / 4; }

}  // namespace crumble
