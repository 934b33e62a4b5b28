#include <fmt/format.h>

#include <ostream>

#include "common/agglomerate/import.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/io/errors.hpp"
#include "common/io/file_errors.hpp"
#include "common/tool/closed_file.hpp"
#include "common/tool/made_of.hpp"
#include "common/tool/verbs.hpp"

namespace crumble::tool {
namespace {

std::string settings(const ImportOptions& how) {
  std::string text =
      fmt::format("[import]\nunit = {:e}  # m\ncontact_tolerance = {}\n", how.unit, how.contact_tolerance);
  if (how.radius) text += fmt::format("radius = {}  # m\n", *how.radius);
  return text + "\n" + material_text(how.material);
}

}  // namespace

int import_file(const ImportFileOptions& options, const Typed& typed, std::ostream& out) {
  const OwnedOutputs owned = own_output(options.output, options.input);
  Imported result;
  std::size_t frames = 1;
  const MadeOf made = made_of(options.material, {});
  ImportOptions how = options.how;
  how.material = made.material;
  try {
    const PointList points = read_points(options.input);
    frames = static_cast<std::size_t>(points.frames);
    result = import_points(points, how);
  } catch (const PointListOpenError& error) {
    throw OpenError(std::string("agglomerate: ") + error.what());
  } catch (const PointListError& error) {
    throw FormatError(error.what());
  }
  const auto provenance = make_provenance("agglomerate", typed, 0, "none", options.input);
  const Particles& particles = result.closed.agglomerate.particles;
  write_closed(options.output, result.closed, provenance, settings(how), made.properties);
  out << fmt::format("{} -> {}: {} spheres{}, {} pairs taken as contacts; radius {:.6g} nm; {}\n", options.input,
                     options.output, particles.size(),
                     frames > 1 ? fmt::format(" (the last of {} frames)", frames) : "", result.touching,
                     1e9 * mean_radius(particles), made.text);
  tell(out, result.closed);
  return 0;
}

}  // namespace crumble::tool
