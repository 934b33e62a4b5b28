#include "common/io/surface_forces_parameters.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/surface_forces/pair_forces.hpp"
#include "common/surface_forces/stability.hpp"

namespace crumble {

using P = Parameter;

namespace {

constexpr double boltzmann_constant = 1.380649e-23;  // J/K, exact (SI 2019)
constexpr double sodium_chloride = 5400;             // mol/m^3 in a saturated solution at 25 C
// Where the forms were compared with the Poisson-Boltzmann equation (tests/surface_forces/laws.cpp).
constexpr double largest_reduced_potential = 8, small_reduced_potential = 2, smallest_kappa_a = 0.1;

const std::string table = "surface_forces.";

double temperature_of(const SurfaceForces& f) { return f.electrolyte.thermal_energy / boltzmann_constant; }

// A number outside all that is possible is one of another unit, as a rule.
void require_between(const Scene& scene, const std::string& name, double low, double high, const char* what,
                     const char* other_unit, double factor) {
  const std::string key = table + name;
  if (!scene.is_set(key)) return;
  const double value = std::abs(scene.real(key));
  if (value == 0 || (value >= low && value <= high)) return;
  const double meant = factor * scene.real(key);
  throw scene.error(key, fmt::format("{}; {:g} to {:g} is possible{}", what, low, high,
                                     std::abs(meant) >= low && std::abs(meant) <= high
                                         ? fmt::format("; if {} were meant, write {:g}", other_unit, meant)
                                         : std::string()));
}

}  // namespace

Section surface_forces_section() {
  return {
      "surface_forces",
      "Forces between surfaces that do not touch yet, in the liquid alone: van der Waals attraction and the "
      "repulsion of equal charges (DLVO), between pairs whose centres both lie in it. Without this table there "
      "are none. common/surface_forces/README.md has the equations and what they hold for.",
      {P::real("hamaker", "J", "Hamaker constant A of the particles across the liquid; 0: no attraction before contact")
           .at_least(0)
           .optional(),
       P::real("surface_potential", "V",
               "Potential of the surfaces (the zeta potential, as a rule), kept while the salt is concentrated; 0: "
               "uncharged")
           .optional(),
       P::real("surface_charge", "C m-2", "In its place the charge of the surfaces, kept instead of the potential")
           .optional(),
       P::real("ionic_strength", "mol m-3",
               "Of ions of valence 1 (1 mol m-3 is 1 mmol/l), at the start where the liquid dries")
           .or_by("ionic_strength_molar", 1000)
           .above(0)
           .optional(),
       P::real("solubility", "mol m-3", "Ionic strength at which the salt crystallises; sodium chloride's by default")
           .above(0)
           .by_default(sodium_chloride),
       P::real("relative_permittivity", "", "Of the liquid; water's at 25 C by default")
           .at_least(1)
           .at_most(200)
           .by_default(78.4),
       P::real("retardation_wavelength", "m",
               "Wavelength lambda of retardation, often 1e-7; without it attraction is not retarded")
           .above(0)
           .optional(),
       P::real("cut_off", "m",
               "Gap beyond which two particles do not feel each other; without it where 0.01 kT is left")
           .above(0)
           .optional(),
       P::flag("sets_surface_energy",
               "material.surface_energy follows from the Hamaker constant: A/(24 pi D0^2), D0 = 0.165 nm")
           .by_default(false)}};
}

std::optional<SurfaceForces> surface_forces_in(const Scene& scene, double temperature) {
  const auto set = [&](const char* name) { return scene.is_set(table + name); };
  if (!set("hamaker")) {
    for (const char* name :
         {"surface_potential", "surface_charge", "ionic_strength", "retardation_wavelength", "cut_off"})
      if (set(name))
        throw scene.error(table + name,
                          "has a meaning only with surface_forces.hamaker; give it in J (0: no attraction before "
                          "contact), or remove the table");
    if (scene.flag(table + "sets_surface_energy"))
      throw scene.error(table + "sets_surface_energy", "needs surface_forces.hamaker");
    return std::nullopt;
  }
  require_between(scene, "hamaker", 1e-23, 1e-18, "no Hamaker constant is so large or small", "zJ (1e-21 J)", 1e-21);
  require_between(scene, "surface_potential", 1e-5, 0.5, "no surface in a liquid has this potential in V", "mV", 1e-3);
  require_between(scene, "surface_charge", 1e-6, 2, "no surface in a liquid has this charge in C/m2", "uC/cm2", 1e-2);
  require_between(scene, "ionic_strength", 1e-3, 2e4,
                  "no liquid has this ionic strength in mol m-3 (water that has met air: 2e-3 at least)", "mol/l",
                  1000);
  require_between(scene, "retardation_wavelength", 1e-8, 1e-5, "retardation begins at wavelengths of light, in m", "nm",
                  1e-9);
  require_between(scene, "cut_off", 1e-10, 1e-4, "no surface forces reach so far or so little, in m", "nm", 1e-9);
  SurfaceForces f;
  f.hamaker = scene.real(table + "hamaker");
  if (set("surface_potential") == set("surface_charge"))
    throw scene.error(table + "hamaker", set("surface_potential")
                                             ? "surface_forces.surface_potential and .surface_charge say the same "
                                               "thing twice; remove one of the two"
                                             : "needs surface_forces.surface_potential in V (0: uncharged) or "
                                               "surface_forces.surface_charge in C m-2 beside it");
  if (set("surface_potential")) f.surface_potential = scene.real(table + "surface_potential");
  if (set("surface_charge")) f.surface_charge = scene.real(table + "surface_charge");
  const bool charged = f.surface_charge.value_or(f.surface_potential) != 0;
  if (charged && !set("ionic_strength"))
    throw scene.error(table + (f.surface_charge ? "surface_charge" : "surface_potential"),
                      "needs surface_forces.ionic_strength in mol m-3, which screens it");
  if (!charged && f.hamaker == 0)
    throw scene.error(table + "hamaker", "and charge are both 0: remove the table, which then changes nothing");
  f.solubility = scene.real(table + "solubility");
  f.electrolyte = {set("ionic_strength") ? scene.real(table + "ionic_strength") : 1,
                   scene.real(table + "relative_permittivity") * vacuum_permittivity, boltzmann_constant * temperature};
  if (f.electrolyte.ionic_strength > f.solubility)
    throw scene.error(table + "ionic_strength", fmt::format("is beyond surface_forces.solubility = {:g} mol m-3 ({})",
                                                            f.solubility, scene.where(table + "solubility")));
  if (set("retardation_wavelength")) f.retardation_wavelength = scene.real(table + "retardation_wavelength");
  if (set("cut_off")) f.range = scene.real(table + "cut_off");
  return f;
}

void check_surface_forces(const Scene& scene, const SurfaceForces& f, const Material& material, double smallest,
                          double largest) {
  const std::string charge = table + (f.surface_charge ? "surface_charge" : "surface_potential");
  for (const double a : {smallest, largest}) {
    const double y = std::abs(surface_potential(f, f.electrolyte, a)) / f.electrolyte.thermal_voltage();
    const double kappa_a = f.electrolyte.inverse_debye_length() * a;
    if (y > largest_reduced_potential)
      throw scene.error(charge,
                        fmt::format("means {:.3g} V at the surface; the law of the double layer holds up to "
                                    "{:.3g} V at {:g} K",
                                    y * f.electrolyte.thermal_voltage(),
                                    largest_reduced_potential * f.electrolyte.thermal_voltage(), temperature_of(f)));
    if (kappa_a < smallest_kappa_a && y > small_reduced_potential)
      throw scene.error(charge,
                        fmt::format("means {:.3g} V at kappa a = {:.2g}, where the law of the double layer is off by "
                                    "more than 2 %; it holds from kappa a = {:g} on, that is from "
                                    "surface_forces.ionic_strength = {:.2g} mol m-3, or up to {:.3g} V",
                                    y * f.electrolyte.thermal_voltage(), kappa_a, smallest_kappa_a,
                                    f.electrolyte.ionic_strength * std::pow(smallest_kappa_a / kappa_a, 2),
                                    small_reduced_potential * f.electrolyte.thermal_voltage()));
  }
  // Between less than an atom and where the continuum of Hamaker holds for sure.
  constexpr double nearest = 0.05e-9, farthest = 1e-9;
  const std::vector<double> radius{largest, largest};
  const BondLaws bonds({}, material, radius);
  const SurfaceForceLaws laws(f, bonds, radius);
  const PairForces pair = laws(0, 1);
  const double joined = pair.attraction.joined_gap(), matching = surface_energy_of(f.hamaker);
  if (f.hamaker > 0 && pair.attraction.step() < 1e-6 * pair.attraction.contact().pull_off_force() &&
      (joined < nearest || joined > farthest))
    throw scene.error(table + "hamaker",
                      fmt::format("is cut off by the contact law where the attraction equals the pull-off force of "
                                  "material.surface_energy = {:g} J/m2, at a gap of {:.3g} nm, which is no gap of two "
                                  "surfaces; of this Hamaker constant {:.3g} J/m2 follow: set "
                                  "surface_forces.sets_surface_energy = true or another of the two",
                                  material.surface_energy, joined * 1e9, matching));
  if (!(pair.pull_off_force() > 0))
    throw scene.error(charge, fmt::format("repels with {:.3g} N at contact, more than the pull-off force of "
                                          "material.surface_energy = {:g} J/m2, {:.3g} N: nothing would hold together",
                                          -pair.repulsion.tension(joined), material.surface_energy,
                                          pair.attraction.contact().pull_off_force()));
  if (f.range && *f.range < 2 * joined)
    throw scene.error(table + "cut_off",
                      fmt::format("ends the attraction within the joint with the contact law, {:.3g} "
                                  "m; give {:.2g} m or more, or none",
                                  joined, 2 * joined));
}

void take_surface_energy(const Scene& scene, Material& material) {
  if (!scene.is_set(table + "hamaker") || !scene.flag(table + "sets_surface_energy")) return;
  const std::string key = "material.surface_energy";
  if (scene.origin(key) == Scene::Origin::given)
    throw scene.error(key,
                      fmt::format("is also to follow from the Hamaker constant (surface_forces.sets_surface_energy, "
                                  "{}); remove one of the two",
                                  scene.where(table + "sets_surface_energy")));
  if (scene.real(table + "hamaker") == 0)
    throw scene.error(table + "sets_surface_energy",
                      "makes contacts without any cohesion of surface_forces.hamaker = 0");
  material.surface_energy = surface_energy_of(scene.real(table + "hamaker"));
}

PairOutlook outlook(const SurfaceForces& forces, const ContactChoice& contact, const Material& material, double a,
                    double ionic_strength) {
  const std::vector<double> radius{a, a};
  const BondLaws bonds(contact, material, radius);
  SurfaceForceLaws laws(forces, bonds, radius);
  laws.set_ionic_strength(ionic_strength);
  const PairForces pair = laws(0, 1);
  const double kT = forces.electrolyte.thermal_energy;
  PairOutlook o;
  o.ionic_strength = ionic_strength;
  o.debye_length = 1 / laws.kappa();
  o.kappa_a = laws.kappa() * a;
  o.potential = surface_potential(forces, laws.electrolyte(), a);
  o.joined_gap = pair.attraction.joined_gap();
  o.joined_step = pair.attraction.step();
  o.range = pair.range;
  o.pull_off_force = pair.attraction.contact().pull_off_force();
  o.pull_off_force_in_liquid = pair.pull_off_force();
  // The plain laws: what is joined to the contact lies inside of every barrier.
  const VanDerWaals attraction = pair.attraction.outer();
  const auto attracted = [&](double h) { return attraction.hamaker > 0 ? attraction.energy(h) / kT : 0; };
  const auto energy = [&](double h) { return attracted(h) + pair.repulsion.energy(h) / kT; };
  const double far = std::max(10 * a, 10 * o.debye_length);
  const auto top = barrier(energy, 1e-12, far);
  if (top) o.barrier = top->value, o.barrier_gap = top->gap;
  if (!top && attraction.hamaker == 0) o.barrier = energy(0), o.barrier_gap = 0;
  if (const auto well = top ? outer_minimum(energy, top->gap, far) : std::nullopt)
    o.well = well->value, o.well_gap = well->gap;
  for (double h = top ? top->gap : 1e-11; h < far; h *= 1.01) {
    const double tension = (attraction.hamaker > 0 ? attraction.tension(h) : 0) + pair.repulsion.tension(h);
    o.largest_repulsion = std::max(o.largest_repulsion, -tension);
  }
  o.log_W_free = log_stability_ratio(energy, attracted, a, Drainage::free);
  o.log_W_lubricated = log_stability_ratio(energy, attracted, a, Drainage::lubricated);
  return o;
}

namespace {

std::string exponential(double logarithm) {
  return logarithm < 600 ? fmt::format("{:.3g}", std::exp(logarithm))
                         : fmt::format("1e{:.0f}", logarithm / std::log(10));
}

}  // namespace

std::vector<std::string> describe(const PairOutlook& o, const std::string& name) {
  std::vector<std::string> lines;
  lines.push_back(
      fmt::format("surface forces {}: ionic strength {:.4g} mol/m3, Debye length {:.3g} nm, kappa a = {:.3g}, "
                  "potential {:.3g} mV, range {:.3g} nm",
                  name, o.ionic_strength, o.debye_length * 1e9, o.kappa_a, o.potential * 1e3, o.range * 1e9));
  std::string text = o.barrier ? fmt::format("  barrier {:.3g} kT at {:.3g} nm, largest repulsion {:.3g} pN",
                                             *o.barrier, *o.barrier_gap * 1e9, o.largest_repulsion * 1e12)
                               : std::string("  no barrier");
  if (o.well && *o.well < -0.1)
    text += fmt::format(", secondary minimum {:.2g} kT at {:.3g} nm", *o.well, *o.well_gap * 1e9);
  text += fmt::format("; stability ratio W = {} (free draining, as computed here), {} (with lubrication)",
                      exponential(o.log_W_free), exponential(o.log_W_lubricated));
  lines.push_back(text);
  lines.push_back(fmt::format(
      "  pull-off force {:.4g} N, in this liquid {:.4g} N; attraction joins the contact law at "
      "{:.3g} nm{}",
      o.pull_off_force, o.pull_off_force_in_liquid, o.joined_gap * 1e9,
      o.joined_step > 1e-6 * o.pull_off_force ? fmt::format(", the force steps there by {:.3g} N", o.joined_step)
                                              : std::string()));
  return lines;
}

void report_outlook(Report& report, const std::string& group, const PairOutlook& o) {
  const auto maybe = [](const std::optional<double>& value) {
    return value ? Report::Value(*value) : Report::Value(nullptr);
  };
  const auto put = [&](const char* name, Report::Value value) { report.result(group + "." + name, std::move(value)); };
  put("ionic_strength_mol_per_m3", o.ionic_strength);
  put("debye_length_nm", o.debye_length * 1e9);
  put("kappa_a", o.kappa_a);
  put("surface_potential_v", o.potential);
  put("barrier_kt", maybe(o.barrier));
  put("barrier_gap_nm", o.barrier_gap ? Report::Value(*o.barrier_gap * 1e9) : Report::Value(nullptr));
  put("largest_repulsion_n", o.largest_repulsion);
  put("secondary_minimum_kt", maybe(o.well));
  put("ln_stability_ratio_free_draining", o.log_W_free);
  put("ln_stability_ratio_lubricated", o.log_W_lubricated);
  put("pull_off_force_n", o.pull_off_force);
  put("pull_off_force_in_liquid_n", o.pull_off_force_in_liquid);
  put("joined_gap_nm", o.joined_gap * 1e9);
  put("range_nm", o.range * 1e9);
}

}  // namespace crumble
