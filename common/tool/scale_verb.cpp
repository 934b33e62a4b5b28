#include <fmt/format.h>

#include <ostream>

#include "common/agglomerate/morphology.hpp"
#include "common/io/agglomerate_reader.hpp"
#include "common/io/errors.hpp"
#include "common/tool/closed_file.hpp"
#include "common/tool/made_of.hpp"
#include "common/tool/verbs.hpp"

namespace crumble::tool {

int scale(const ScaleOptions& options, const Typed& typed, std::ostream& out) {
  const OwnedOutputs owned = own_output(options.output, options.input);
  const AgglomerateReader reader(options.input);
  Agglomerate before{reader.particles(), reader.last_frame()};
  const double old = mean_radius(before.particles);
  if (const auto open = open_contact(before, largest_listed_gap)) throw InputError(options.input + ": " + *open);
  const MadeOf made = made_of(options.material, reader.info().properties);
  const Rescaled result = rescaled(std::move(before), options.radius, made.material);
  const auto provenance = make_provenance("agglomerate", typed, 0, "none", options.input);
  const std::string settings =
      fmt::format("[scale]\nradius = {}  # m\n\n", options.radius) + material_text(made.material);
  write_closed(options.output, result, provenance, settings, made.properties);
  out << fmt::format("{} -> {}: {} spheres, radius {:.6g} nm -> {:.6g} nm, scaled by {:g}; {}\n", options.input,
                     options.output, result.agglomerate.particles.size(), 1e9 * old, 1e9 * options.radius, result.scale,
                     made.text);
  tell(out, result);
  return 0;
}

}  // namespace crumble::tool
