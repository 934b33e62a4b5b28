#include "common/tool/closed_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <stdexcept>

#include "common/agglomerate/morphology.hpp"
#include "common/io/agglomerate_writer.hpp"

namespace crumble::tool {
namespace {

void tell_pairs(std::ostream& out, const Particles& particles, const char* what, const std::vector<NearPair>& pairs) {
  constexpr std::size_t shown = 10;
  out << fmt::format("  {}: {}\n", what, pairs.size());
  for (std::size_t k = 0; k < std::min(pairs.size(), shown); ++k) {
    const double a = pair_radius(particles.radius[static_cast<std::size_t>(pairs[k].i)],
                                 particles.radius[static_cast<std::size_t>(pairs[k].j)]);
    out << fmt::format("    {}-{}, gap {:.3g} nm ({:.3g} radii)\n", pairs[k].i, pairs[k].j, 1e9 * pairs[k].gap,
                       pairs[k].gap / a);
  }
  if (pairs.size() > shown) out << fmt::format("    and {} more\n", pairs.size() - shown);
}

void write_morphology(AgglomerateWriter& writer, const Particles& particles, const Frame& frame) {
  const RadialExtent extent = radial_extent(frame.position, particles.radius, particles.mass);
  const std::string method = "mean over the outer and inner tenth of the particles, Vasquez Giuliano et al. 2022, 3.1";
  writer.put("/morphology/diameter", extent.diameter(), method);
  writer.put("/morphology/crust_thickness", extent.crust_thickness(), method);
  writer.put("/morphology/void_radius", extent.inner, method);
  writer.put("/morphology/porosity", porosity(frame.position, particles.radius, particles.mass, extent.outer));
  writer.put<double>("/morphology/radial_position", radial_positions(frame.position, particles.mass),
                     {frame.position.size()});
}

}  // namespace

OwnedOutputs own_output(const std::string& output, const std::string& input) {
  return {{{.what = "agglomerate: -o", .name = output}}, {{"the input", input}}};
}

void tell(std::ostream& out, const Particles& particles, const Closed& closed) {
  const std::vector<Contact>& contacts = closed.frame.contacts;
  out << fmt::format("  contacts: {}, coordination {:.3f}; largest move in closing them {:.3g} nm\n", contacts.size(),
                     coordination_number(particles.size(), contacts.size()), 1e9 * closed.largest_move);
  out << fmt::format(
      "  residual self-stress, in pull-off forces: rms {:.3g}, largest tension {:.3g}, largest compression {:.3g}\n",
      closed.tension_rms, closed.tension_max, closed.compression_max);
  out << fmt::format("  distance from the equilibrium gap: rms {:.3g} nm, largest {:.3g} nm\n",
                     1e9 * closed.residual_rms, 1e9 * closed.residual_max);
  tell_pairs(out, particles, "contacts lost (open beyond the pull-off gap)", closed.lost);
  tell_pairs(out, particles, "overlapping pairs that are not contacts", closed.unlisted);
}

void write_closed(const std::string& file, const Particles& particles, const Closed& closed,
                  const Provenance& provenance, const std::string& settings, std::optional<double> scale) {
  if (!closed.converged) {
    throw std::runtime_error(fmt::format(
        "{}: not written: closing the contacts did not converge in {} steps (a smaller --contact-tolerance takes "
        "fewer doubtful pairs for contacts)",
        file, closed.iterations));
  }
  FileDescription description;
  description.stage = "agglomerate";
  description.provenance = provenance;
  description.resolved = settings;
  AgglomerateWriter writer(followed(file), particles, description);
  writer.append(closed.frame);
  double squares = 0, largest = 0;
  for (const Contact& c : closed.frame.contacts) {
    squares += c.normal_force * c.normal_force;
    largest = std::max(largest, std::abs(c.normal_force));
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, closed.frame.contacts.size()));
  writer.put("/closing/residual_rms", std::sqrt(squares / count));
  writer.put("/closing/residual_max", largest);
  writer.put("/closing/lost_contacts", static_cast<double>(closed.lost.size()));
  if (scale) writer.put("/closing/scale", *scale);
  write_morphology(writer, particles, closed.frame);
  writer.finish("relaxed");
}

std::string material_text(const Material& m) {
  return fmt::format("[material]\nyoungs_modulus = {:e}  # Pa\npoisson_ratio = {}\nsurface_energy = {:e}  # J/m^2\n",
                     m.youngs_modulus, m.poisson_ratio, m.surface_energy);
}

}  // namespace crumble::tool
