#include <fmt/format.h>

#include "common/io/schema.hpp"

namespace crumble {

namespace {

using schema::Layout;

std::string stages(unsigned mask) {
  if (mask == schema::all) return "all";
  std::string list;
  for (const auto& [stage, name] : {std::pair{schema::dryer, "dryer"},
                                    {schema::breaker, "breaker"},
                                    {schema::rigidstress, "rigidstress"},
                                    {schema::agglomerate, "agglomerate"}})
    if (mask & stage) list += (list.empty() ? "" : ", ") + std::string(name);
  return list.empty() ? "-" : list;
}

std::string what(const schema::Entry& entry) {
  switch (entry.layout) {
    case Layout::group:
      return "group";
    case Layout::link:
      return "soft link";
    default:
      break;
  }
  std::string text(hdf5::type_name(entry.type));
  for (const auto word : schema::words(entry.shape)) text += fmt::format("[{}]", word);
  return text;
}

std::string meaning(const schema::Entry& entry) {
  std::string text(entry.meaning);
  for (std::string values(entry.values); !values.empty();) {
    const auto end = values.find('|');
    text += (text.ends_with('`') && values.size() < entry.values.size() ? ", `" : ": `") + values.substr(0, end) + "`";
    values.erase(0, end == values.npos ? end : end + 1);
  }
  if (!entry.symbol.empty())
    text += fmt::format(" ({}{}{})", entry.symbol, entry.equation.empty() ? "" : ", Eq ", entry.equation);
  return text;
}

constexpr const char* head = R"(# The agglomerate file, schema version {}.{}

This page is generated from the table in `schema.cpp`; regenerate it with `agglomerate schema > common/io/SCHEMA.md`.

An agglomerate file is an HDF5 file after H5MD 1.1 with its module `units` and a module of our own, `agglomerate`. All
stages read and write it, and it is all that they share. `agglomerate check FILE` compares a file with this page.

**Units.** Lengths are in nm, everything else is in SI. Every dimensional array has an attribute `unit`, a dimensionless
one has none. Unit texts are of variable length, because MDAnalysis 2.4.2 does not accept the fixed length that H5MD asks
for.

**Signs.** Tension is positive, a gap is positive when the surfaces are apart, a normal points from i to j, and i < j.

**Shapes.** T frames, N particles, M contacts of all frames together, L contacts of the last frame; other letters hold
within their group. C order, little-endian. A row marked *frames* is a group of `step` int64[T], `time` float64[T] in s
and `value`; `step` and `time` are hard links to those of the positions. A row marked *samples* is such a group with a
length of its own.

**Versions.** A program reads files of its own major version whose minor version is not newer than its own. An addition
raises the minor number, a changed meaning the major one.

**Valid.** The checker refuses, and so by the same rules does every program that reads a file, what differs from this table and
what has no meaning: two particles at one place, a gap or normal that is not that of the positions, a contact open by more than a
radius, a force below that of a smaller gap (JKR; one rising function for all pairs), displacements along the normal, masses and
radii of no colloid, observables, labels and radial positions that do not follow from positions and contacts, events, pairs and
fragments of particles that are not there, gradients of a compressible flow. What a program writes has passed the same rules
before it gets its name. A parent that has changed since is a violation to the checker alone.

**Complete.** A program writes NAME.tmp, sets `complete` to 1, closes the file and renames it. A file whose `complete`
is 0 is not a result.

| path | type | unit | required of | meaning |
|---|---|---|---|---|
)";

}  // namespace

std::string schema_page() {
  std::string page = fmt::format(head, schema::version_major, schema::version_minor);
  for (const schema::Entry& entry : schema::table()) {
    const std::string kind = entry.layout == Layout::frames    ? "frames "
                             : entry.layout == Layout::samples ? "samples "
                                                               : "";
    page +=
        fmt::format("| `{}` | {}{} | {} | {} | {} |\n", entry.path, kind, what(entry),
                    entry.unit == "any" ? "as the attribute says" : entry.unit, stages(entry.required), meaning(entry));
  }
  return page;
}

}  // namespace crumble
