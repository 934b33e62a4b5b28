// The agglomerate file: one table that drives the writer, the reader, the checker and the page SCHEMA.md.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/hdf5.hpp"

namespace crumble::schema {

// Files of another major version, or of a newer minor version, are refused. An addition raises the minor number, a
// changed meaning the major one.
inline constexpr int version_major = 1, version_minor = 2;

// Which program wrote the file; a row of the table names the stages in which it is required.
enum Stage : unsigned { none = 0, dryer = 1, breaker = 2, rigidstress = 4, agglomerate = 8, all = 15 };
std::optional<Stage> stage_named(std::string_view name);

enum class Layout {
  group,
  attribute,  // path is OBJECT@NAME
  dataset,
  frames,   // group of step, time (hard links to those of the positions) and value, one row for each frame
  samples,  // group of step, time and value with a length of its own
  link
};

struct Entry {
  std::string_view path;  // <name> stands for any one name
  Layout layout;
  hdf5::Type type;
  std::string_view shape;  // sizes and symbols: T frames, N particles, M contacts, L contacts of the last frame
  std::string_view unit;   // empty: dimensionless; "any": as its attribute says
  unsigned required;       // stages
  std::string_view meaning;
  std::string_view symbol = "", equation = "";  // of Vasquez Giuliano et al. (2022)
  std::string_view values = "";                 // the values allowed, separated by |
};

std::span<const Entry> table();

// The row for a path, without the trailing /value, /step or /time of a time-dependent one.
const Entry* find(std::string_view path);

// The words of a shape, "T N 3" -> T, N, 3.
std::vector<std::string_view> words(std::string_view text);

// What a value in SI is multiplied with in the file: lengths are stored in nm.
double file_factor(std::string_view unit);

}  // namespace crumble::schema

namespace crumble {

// The text of common/io/SCHEMA.md.
std::string schema_page();

}  // namespace crumble
