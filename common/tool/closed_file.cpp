#include "common/tool/closed_file.hpp"

#include <fmt/format.h>

#include <ostream>

#include "common/agglomerate/morphology.hpp"
#include "common/io/granule.hpp"

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

void tell(std::ostream& out, const Rescaled& r) {
  const Particles& particles = r.agglomerate.particles;
  const std::vector<Contact>& contacts = r.agglomerate.state.contacts;
  out << fmt::format("  contacts: {}, coordination {:.3f}; largest move in closing them {:.3g} nm\n", contacts.size(),
                     coordination_number(particles.size(), contacts.size()), 1e9 * r.largest_move);
  out << fmt::format(
      "  residual self-stress, in pull-off forces: rms {:.3g}, largest tension {:.3g}, largest compression {:.3g}\n",
      r.self_stress.rms_use, r.largest_tension, r.largest_compression);
  out << fmt::format("  distance from the equilibrium gap: rms {:.3g} nm, largest {:.3g} nm\n", 1e9 * r.gap_rms,
                     1e9 * r.gap_max);
  tell_pairs(out, particles, "contacts lost (open beyond the pull-off gap)", r.lost);
  out << fmt::format("  new contacts (pairs that closing brought to overlap): {}\n", r.made);
}

void write_closed(const std::string& file, const Rescaled& r, const Provenance& provenance, const std::string& settings,
                  const Properties& properties) {
  const Particles& particles = r.agglomerate.particles;
  FileDescription description;
  description.stage = "agglomerate";
  description.provenance = provenance;
  description.resolved = settings;
  AgglomerateWriter writer(followed(file), particles, description);
  writer.append(r.agglomerate.state);
  writer.put("/closing/residual_rms", r.self_stress.rms);
  writer.put("/closing/residual_max", r.self_stress.max);
  writer.put("/closing/lost_contacts", static_cast<double>(r.lost.size()));
  writer.put("/closing/scale", r.scale);
  write_properties(writer, properties);
  write_morphology(writer, particles, r.agglomerate.state);
  writer.finish("relaxed");
}

std::string material_text(const Material& m) {
  return fmt::format(
      "[material]\nyoungs_modulus = {:e}  # Pa\npoisson_ratio = {}\nsurface_energy = {:e}  # J/m^2\n"
      "density = {}  # kg/m^3\n",
      m.youngs_modulus, m.poisson_ratio, m.surface_energy, m.density);
}

}  // namespace crumble::tool
