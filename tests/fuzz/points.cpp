// Spheres as CSV and XYZ, and what is made of them.
#include <fmt/format.h>

#include "common/agglomerate/import.hpp"
#include "tests/fuzz/harness.hpp"

namespace crumble::fuzz {

namespace {

std::string imported(const PointList& points) {
  ImportOptions options;
  if (points.radius.empty()) options.radius = 10e-9;
  if (points.position.size() > 100) return fmt::format("{} spheres, not closed here", points.position.size());
  const Imported result = import_points(points, options);
  for (const Vector3& x : result.closed.agglomerate.state.position)
    if (!x.allFinite()) throw Finding("an imported position is no number");
  return fmt::format("{} spheres, {} touch", points.position.size(), result.touching);
}

template <class Parse>
std::string of_points(std::string_view text, Parse parse) {
  try {
    return imported(parse(text, "points"));
  } catch (const PointListError& error) {
    return std::string("refused: ") + error.what();
  }
}

}  // namespace

std::string points(std::string_view text) {
  const std::string csv = of_points(text, parse_csv), xyz = of_points(text, parse_xyz);
  return "as CSV " + csv + "\nas XYZ " + xyz;
}

}  // namespace crumble::fuzz
