#include "common/io/schema.hpp"

#include <array>
#include <unordered_map>

namespace crumble::schema {

namespace {

using hdf5::Type;
using enum Layout;

constexpr auto i32 = Type::int32, i64 = Type::int64, u8 = Type::uint8, u64 = Type::uint64, f64 = Type::float64,
               str = Type::text, no_type = Type::other;
constexpr unsigned programs = dryer | breaker | rigidstress;

// clang-format off
constexpr auto rows = std::to_array<Entry>({
  // What the file is
  {"/h5md@version", attribute, i32, "2", "", all, "version of H5MD, 1.1"},
  {"/h5md/author@name", attribute, str, "", "", all, "who ran the program"},
  {"/h5md/creator@name", attribute, str, "", "", all, "the program"},
  {"/h5md/creator@version", attribute, str, "", "", all, "its version"},
  {"/h5md/modules/units@version", attribute, i32, "2", "", all, "version of the H5MD module `units`, 1.0"},
  {"/h5md/modules/units@system", attribute, str, "", "", all, "system of units", "", "", "SI"},
  {"/h5md/modules/agglomerate@version", attribute, i32, "2", "", all, "version of this schema: major, minor"},
  {"/h5md/modules/agglomerate@stage", attribute, str, "", "", all, "the program that wrote the file", "", "",
   "dryer|breaker|rigidstress|agglomerate"},
  {"/h5md/modules/agglomerate@state", attribute, str, "", "", all, "state of the last frame", "", "",
   "drying|dry|relaxed|broken"},
  {"/h5md/modules/agglomerate@complete", attribute, u8, "", "", all, "0 while being written, 1 when all is there"},

  // Particles
  {"/particles/all/box@dimension", attribute, i32, "", "", all, "dimension of space, 3"},
  {"/particles/all/box@boundary", attribute, str, "3", "", all, "open space in each direction", "", "", "none"},
  {"/particles/all/position", frames, f64, "T N 3", "nm", all, "centres"},
  {"/particles/all/orientation", frames, f64, "T N 4", "", breaker, "unit quaternions, scalar part first"},
  {"/particles/all/velocity", frames, f64, "T N 3", "m s-1", none, "velocities", "v", "1"},
  {"/particles/all/angular_velocity", frames, f64, "T N 3", "rad s-1", none, "angular velocities"},
  {"/particles/all/force", frames, f64, "T N 3", "N", none, "forces; attribute `meaning` says which"},
  {"/particles/all/torque", frames, f64, "T N 3", "N m", none, "torques; attribute `meaning` says which"},
  {"/particles/all/fragment", frames, i32, "T N", "", breaker, "fragment of each particle, 0 the largest"},
  {"/particles/all/radius", dataset, f64, "N", "nm", all, "radii", "a", ""},
  {"/particles/all/mass", dataset, f64, "N", "kg", all, "masses", "m", "1"},
  {"/particles/all/id", dataset, i64, "N", "", all, "stable names, counted from 0 where the stage began"},
  {"/particles/all/species", dataset, i32, "N", "", all, "kind of particle, 0 unless there are several"},
  {"/particles/trajectory", link, no_type, "", "", all, "soft link to `all`, the name under which MDAnalysis looks"},

  // What the particles are made of and the liquid around them: what the next stage takes. Since version 1.1
  {"/material/youngs_modulus", dataset, f64, "", "Pa", none, "elastic modulus", "E", ""},
  {"/material/poisson_ratio", dataset, f64, "", "", none, "Poisson ratio", "nu", ""},
  {"/material/surface_energy", dataset, f64, "", "J m-2", none, "superficial energy of one surface", "gamma_s", ""},
  {"/material/density", dataset, f64, "", "kg m-3", none, "density of the particles"},
  {"/material/sliding_limit_factor", dataset, f64, "", "", none, "of the critical sliding force", "", "14"},
  {"/material/twisting_limit_factor", dataset, f64, "", "", none, "of the critical twisting torque", "", "17"},
  {"/material/rolling_limit_factor", dataset, f64, "", "", none, "of the critical rolling torque", "", "21"},
  {"/material/rolling_stiffness_factor", dataset, f64, "", "", none, "of the rolling stiffness", "", "20"},
  {"/fluid/viscosity", dataset, f64, "", "Pa s", none, "viscosity of the liquid", "mu", ""},

  // Contacts, all frames one after the other
  {"/connectivity/contacts", dataset, i32, "L 2", "", all, "pairs of the last frame, as H5MD has bonds"},
  {"/contacts/offset", dataset, i64, "T+1", "", all, "contacts of frame t are rows offset[t] to offset[t+1]-1"},
  {"/contacts/pair", dataset, i32, "M 2", "", all, "i and j, rows of the particle arrays; i < j, sorted in a frame"},
  {"/contacts/normal", dataset, f64, "M 3", "", all, "unit vector from i to j", "n", ""},
  {"/contacts/gap", dataset, f64, "M", "nm", all, "distance between the surfaces; positive: separated", "h", "10"},
  {"/contacts/sliding", dataset, f64, "M 3", "nm", all, "elastic sliding displacement, across the normal", "xi_s", "12"},
  {"/contacts/rolling", dataset, f64, "M 3", "rad", all,
   "elastic rolling angle, across the normal: the relative angle of which Eq 20's stiffness gives the torque "
   "(the contact point has moved by a/2 times it)", "theta_r", "19"},
  {"/contacts/twisting", dataset, f64, "M", "rad", all, "elastic twisting angle about the normal", "phi_t", "15"},
  {"/contacts/normal_force", dataset, f64, "M", "N", all, "positive: tension", "N", "10"},
  {"/contacts/sliding_force", dataset, f64, "M 3", "N", all, "acting on j", "S", "12"},
  {"/contacts/twisting_torque", dataset, f64, "M", "N m", all, "acting on j, along the normal", "T", "15"},
  {"/contacts/rolling_torque", dataset, f64, "M 3", "N m", all, "acting on j", "R", "19"},
  {"/contacts/flags", dataset, u8, "M", "", all, "at its limit: bit 0 sliding, bit 1 twisting, bit 2 rolling"},
  {"/contacts/born", dataset, i64, "M", "", all, "step at which the contact was made"},

  // One row a frame
  {"/observables/radius_of_gyration", frames, f64, "T", "nm", all, "root of the mass-weighted mean square distance "
   "of the centres from the centre of mass", "R_g", ""},
  {"/observables/semi_axes", frames, f64, "T 3", "nm", all, "of the ellipsoid of equal inertia, descending"},
  {"/observables/contact_count", frames, i64, "T", "", all, "bonded pairs"},
  {"/observables/coordination_number", frames, f64, "T", "", all, "mean number of contacts of a particle"},
  {"/observables/fragment_count", frames, i64, "T", "", all, "parts that no contact connects"},
  {"/observables/largest_fragment", frames, i64, "T", "", all, "particles in the largest part"},
  {"/observables/droplet_radius", frames, f64, "T", "nm", dryer, "radius of the shrinking droplet", "R", "7"},
  {"/observables/wetted_count", frames, i64, "T", "", dryer, "particles cut by the receding interface"},
  {"/observables/capillary_force", frames, f64, "T", "N", dryer, "largest on a particle", "F_c", "8"},
  {"/observables/flow_stress", frames, f64, "T", "Pa", breaker, "viscosity times shear rate", "mu gamma_dot", ""},
  {"/observables/shear_rate", frames, f64, "T", "s-1", breaker, "root of 2 E:E", "gamma_dot", ""},
  {"/observables/max_tension", frames, f64, "T", "N", breaker, "largest tension of a contact of the pieces that still move", "N_max", ""},
  {"/observables/slipping_count", frames, i64, "T", "", none, "contacts at their sliding limit, of the pieces that still move"},
  {"/observables/rolling_count", frames, i64, "T", "", none, "contacts at their rolling limit, of the pieces that still move"},
  {"/series/<name>", samples, f64, "K", "any", none, "a scalar sampled more densely than the frames; of a breakup: size and shape of the largest piece, contacts and "
   "tensions of all pieces that still move"},

  // The last frame's shape
  {"/morphology/diameter", dataset, f64, "", "nm", none, "twice the mean distance of the farthest tenth of the "
   "particles from the centre of mass, plus a radius each", "d_c", ""},
  {"/morphology/crust_thickness", dataset, f64, "", "nm", none, "outer minus inner radius", "h_c", ""},
  {"/morphology/void_radius", dataset, f64, "", "nm", none, "inner radius: mean distance of the nearest tenth, less a radius"},
  {"/morphology/porosity", dataset, f64, "", "", none, "void fraction within the outer radius"},
  {"/morphology/radial_position", dataset, f64, "N", "nm", none, "distances from the centre of mass, ascending"},

  // Rescaled and imported agglomerates: contacts closed to the equilibrium gap
  {"/closing/residual_rms", dataset, f64, "", "N", none, "root mean square tension that closing left"},
  {"/closing/residual_max", dataset, f64, "", "N", none, "largest absolute tension that closing left"},
  {"/closing/lost_contacts", dataset, i64, "", "", none, "contacts that could not be kept"},
  {"/closing/scale", dataset, f64, "", "", none, "new over old particle radius"},

  // Load on a rigid agglomerate
  {"/response/pair", dataset, i32, "P 2", "", none, "contacts analysed"},
  {"/response/load", dataset, f64, "P 6 5", "any", none, "force and torque on j for each unit strain rate, body frame; "
   "orthonormal basis of the symmetric traceless tensors"},
  {"/response/velocity", dataset, f64, "6 5", "any", none, "velocity of the centre of mass and rotation, relative to the flow there, for each unit strain rate; of the largest connected part"},
  {"/response/basis", dataset, f64, "5 3 3", "", none, "the five basis tensors"},
  {"/response/body_velocity", dataset, f64, "B 6 5", "any", none, "the same for each connected part, largest first"},
  {"/response/body_drag", dataset, f64, "B 6 6", "any", none, "force and torque about the centre of mass against unit velocity and rotation, of each part"},
  {"/response/error", dataset, f64, "", "", none, "estimated relative error of the largest tension"},
  {"/response@hydrodynamics", attribute, str, "", "", none, "method by which the loads of the fluid were found"},
  {"/flows/<name>/gradient", dataset, f64, "3 3", "", none, "velocity gradient for unit shear rate, row i, column j: du_i/dx_j"},
  {"/flows/<name>/normal_force", dataset, f64, "P", "N", none, "tension of each contact at its worst instant"},
  {"/flows/<name>/radial_position", dataset, f64, "P", "nm", none, "distance of each contact from the centre of mass"},
  {"/flows/<name>/time", dataset, f64, "K", "s", none, "instants of the orbit or history"},
  {"/flows/<name>/max_tension", dataset, f64, "K", "N", none, "largest tension at each instant", "N_max", ""},
  {"/flows/<name>/orientation", dataset, f64, "K 4", "", none, "of the body at each instant, scalar part first"},
  {"/flows/<name>/share", dataset, f64, "K", "", none, "share of random starts that end in each orientation"},
  {"/flows/<name>/critical_stress", dataset, f64, "", "Pa", none, "viscosity times shear rate that breaks a contact"},

  // How far each result can be relied on, and breakup. Since version 1.2
  {"/errors/<name>", dataset, f64, "", "", none, "numerical error of a result as the run states it, relative: d_c, h_c_over_d_c, contacts, critical_stress, breakup_time"},
  {"/breakup/critical_stress", dataset, f64, "", "Pa", none, "flow stress at which the last path of contacts to what was lost gave way"},
  {"/breakup/stress", dataset, f64, "", "Pa", none, "the same along a history of the velocity gradient, where it is no strength"},
  {"/breakup/time", dataset, f64, "", "s", none, "when that path gave way"},
  {"/flow@type", attribute, str, "", "", none, "kind of flow", "", "", "quiescent|elongation|elongational|shear|uniaxial|biaxial|history"},
  {"/flow/gradient", dataset, f64, "3 3", "", none, "velocity gradient for unit shear rate, row i, column j: du_i/dx_j; of a history at the breakup, or where the run ended"},
  {"/events/time", dataset, f64, "E", "s", none, "instants, in order"},
  {"/events/stress", dataset, f64, "E", "Pa", none, "flow stress at each"},
  {"/events/kind", dataset, i32, "E", "", none, "0 slip, 1 twist, 2 roll, 3 rupture, 4 contact made, 5 fragment lost"},
  {"/events/pair", dataset, i32, "E 2", "", none, "the contact, or -1 -1"},
  {"/events/fragment_offset", dataset, i64, "E+1", "", none, "sizes of event e are rows offset[e] to offset[e+1]-1"},
  {"/events/fragment_sizes", dataset, i64, "F", "", none, "particles in each fragment, descending"},

  // Where it comes from
  {"/parameters/input", dataset, str, "", "", programs, "the scene as given"},
  {"/parameters/resolved", dataset, str, "", "", programs, "the scene with every default filled in"},
  {"/parameters/provenance@program", attribute, str, "", "", all, "name of the program"},
  {"/parameters/provenance@version", attribute, str, "", "", all, "its version"},
  {"/parameters/provenance@git", attribute, str, "", "", all, "commit it was built from, or `unknown`"},
  {"/parameters/provenance@dirty", attribute, u8, "", "", all, "1 if the sources differed from that commit"},
  {"/parameters/provenance@compiler", attribute, str, "", "", all, "compiler and version"},
  {"/parameters/provenance@flags", attribute, str, "", "", all, "its options"},
  {"/parameters/provenance@blas", attribute, str, "", "", none, "BLAS, its kernel, and whether that or Eigen's ran; since 1.1"},
  {"/parameters/provenance@command", attribute, str, "", "", all, "command line"},
  {"/parameters/provenance@created", attribute, str, "", "", all, "ISO 8601, UTC"},
  {"/parameters/provenance@seed", attribute, u64, "", "", all, "seed of the noise and of the start"},
  {"/parameters/provenance@rng", attribute, str, "", "", all, "random number generator, or `none`"},
  {"/parameters/provenance@parent", attribute, str, "", "", none, "file that this one continues, relative to it"},
  {"/parameters/provenance@parent_sha256", attribute, str, "", "", none, "its SHA-256"},
});
// clang-format on

bool matches(std::string_view pattern, std::string_view path) {
  while (true) {
    const auto a = pattern.find_first_of("/@"), b = path.find_first_of("/@");
    if (pattern.substr(0, a) != path.substr(0, b) && pattern.substr(0, a) != "<name>") return false;
    if (a == pattern.npos || b == path.npos) return a == pattern.npos && b == path.npos;
    if (pattern[a] != path[b]) return false;
    pattern.remove_prefix(a + 1);
    path.remove_prefix(b + 1);
  }
}

}  // namespace

std::optional<Stage> stage_named(std::string_view name) {
  if (name == "dryer") return dryer;
  if (name == "breaker") return breaker;
  if (name == "rigidstress") return rigidstress;
  if (name == "agglomerate") return agglomerate;
  return std::nullopt;
}

std::span<const Entry> table() { return rows; }

// Asked for every array of every file, so most are looked up by their letters.
const Entry* find(std::string_view path) {
  static const auto named = [] {
    std::unordered_map<std::string_view, const Entry*> map;
    for (const Entry& entry : rows)
      if (entry.path.find('<') == entry.path.npos) map.emplace(entry.path, &entry);
    return map;
  }();
  if (const auto entry = named.find(path); entry != named.end()) return entry->second;
  for (const Entry& entry : rows)
    if (entry.path.find('<') != entry.path.npos && matches(entry.path, path)) return &entry;
  return nullptr;
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> list;
  while (!text.empty()) {
    const auto end = text.find(' ');
    list.push_back(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
  return list;
}

double file_factor(std::string_view unit) { return unit == "nm" ? 1e9 : 1; }

}  // namespace crumble::schema
