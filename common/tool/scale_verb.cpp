#include <fmt/format.h>

#include <ostream>

#include "common/agglomerate/morphology.hpp"
#include "common/io/agglomerate_reader.hpp"
#include "common/tool/closed_file.hpp"
#include "common/tool/verbs.hpp"

namespace crumble::tool {

int scale(const ScaleOptions& options, const Typed& typed, std::ostream& out) {
  const OwnedOutputs owned = own_output(options.output, options.input);
  const AgglomerateReader reader(options.input);
  Particles particles = reader.particles();
  Frame frame = reader.last_frame();
  const double old = mean_radius(particles);
  const double factor = options.radius / old;
  for (double& a : particles.radius) a *= factor;
  for (double& m : particles.mass) m *= factor * factor * factor;
  for (Vector3& x : frame.position) x *= factor;
  for (Contact& c : frame.contacts) c.born = 0;
  frame.step = 0;
  frame.time = 0;
  const Closed closed = close_contacts(particles, frame, options.material);
  const auto provenance = make_provenance("agglomerate", typed, 0, "none", options.input);
  const std::string settings =
      fmt::format("[scale]\nradius = {}  # m\n\n", options.radius) + material_text(options.material);
  write_closed(options.output, particles, closed, provenance, settings, factor);
  out << fmt::format("{} -> {}: {} spheres, radius {:.6g} nm -> {:.6g} nm\n", options.input, options.output,
                     particles.size(), 1e9 * old, 1e9 * options.radius);
  tell(out, particles, closed);
  return 0;
}

}  // namespace crumble::tool
