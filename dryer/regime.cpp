#include "dryer/regime.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/io/surface_forces_parameters.hpp"
#include "common/surface_forces/stability.hpp"
#include "dryer/drag.hpp"
#include "dryer/inertial.hpp"
#include "dryer/outcome.hpp"
#include "dryer/thermal_rupture.hpp"

namespace crumble::dryer {

DryingRegime drying_regime(const DryingModel& model, double a, double solids_fraction) {
  const Droplet& droplet = model.droplet;
  const double R0 = droplet.initial_radius;
  DryingRegime r;
  r.solids_fraction = solids_fraction;
  r.diffusivity = model.thermal_energy / drag_coefficient(model.viscosity, a);
  r.evaporation_constant = R0 * R0 / droplet.lifetime;
  r.peclet = r.diffusivity > 0 ? droplet.peclet(r.diffusivity) : std::numeric_limits<double>::infinity();
  r.front_speed = droplet.front_speed(R0);
  r.packed_front_speed = droplet.front_speed(std::min(R0, R0 * std::cbrt(2 * solids_fraction)));
  r.capillary_speed = droplet.surface_tension / (3 * model.viscosity);
  r.force_ratio =
      capillary_force(droplet.surface_tension, a, 0) / BondLaw(model.contact, model.material, a, a).pull_off_force();
  return r;
}

DryingRegime drying_regime(const DryingScene& s) {
  const double R0 = s.model.droplet.initial_radius;
  double solids = 0;  // sum of a^3
  for (const double radius : s.radius) solids += radius * radius * radius;
  return drying_regime(s.model, s.nominal_radius, solids / (R0 * R0 * R0));
}

// Beyond Pe = 100 the steady profile exp(Pe rho^2/4) of diffusion against the front falls by e within 2 % of the
// radius. What becomes of the droplet is said by outcome.hpp.
std::string DryingRegime::words() const {
  std::string text = diffusion_dominated()   ? "diffusion-dominated: Brownian motion keeps the particles spread"
                     : advection_dominated() ? "advection-dominated: the front sweeps the particles up"
                                             : "between diffusion and advection";
  if (front_speed > capillary_speed)
    text += "; capillary-limited from the start: the front leaves the particles dry where they are";
  else if (capillary_limited())
    text += fmt::format("; capillary-limited at the end: below R = {:.3g} nm the front leaves particles dry",
                        outrun_radius() * 1e9);
  return text;
}

std::string_view integrator_summary(const DryingScene& s) {
  switch (s.integrator) {
    case IntegratorKind::inertial:
      return Inertial::summary;
    case IntegratorKind::implicit:
      return Implicit::summary;
    case IntegratorKind::stabilised:
      return Stabilised::summary;
    case IntegratorKind::brownian:
      break;
  }
  return Brownian::summary;
}

namespace {

// Where the solids take up this share of what is left: a random packing is full, the liquid is what is in its pores.
constexpr double packed = 0.64;

// The pair at the start, and with the salt that the packed droplet has.
std::optional<std::pair<PairOutlook, PairOutlook>> outlooks(const DryingScene& s) {
  if (!s.model.surface_forces) return std::nullopt;
  const SurfaceForces& f = *s.model.surface_forces;
  const double phi = drying_regime(s).solids_fraction;
  const double end = concentrated(f.electrolyte.ionic_strength, 1 - phi, phi / packed - phi, f.solubility);
  const auto at = [&](double I) { return outlook(f, s.model.contact, s.model.material, s.nominal_radius, I); };
  return std::pair{at(f.electrolyte.ionic_strength), at(end)};
}

// Why it is the scene's.
std::string integrator_reason(const DryingScene& s) {
  if (s.model.thermal_energy == 0 || s.model.contact.normal != NormalLaw::jkr) return "";
  const ThermalRupture rupture = thermal_rupture(s);
  const std::string bond = fmt::format("; a bond is worth {:.3g} kT, ", rupture.bond);
  if (!rupture.never()) return bond + "thermal motion breaks it";
  const std::string none =
      bond + fmt::format("thermal motion breaks at most {:.0e} of them in the whole drying", rupture.most);
  if (!s.is(IntegratorKind::stabilised)) return none;
  return none +
         fmt::format(": steps follow diffusion ({:.2g} s for {:.2g} a) and the front, not how stiff contacts are",
                     ThermalLoads::interval(s.model, s.smallest_radius(), s.stabilised.brownian_displacement),
                     s.stabilised.brownian_displacement);
}

}  // namespace

std::string integrator_text(const DryingScene& s) { return std::string(integrator_summary(s)) + integrator_reason(s); }

std::vector<std::string> describe(const DryingScene& s) {
  const DryingRegime r = drying_regime(s);
  const double a = s.nominal_radius, R0 = s.model.droplet.initial_radius, mu = s.model.viscosity;
  const double sigma = s.model.droplet.surface_tension, force = capillary_force(sigma, a, 0);
  const double m = 4.0 / 3.0 * std::numbers::pi * a * a * a * s.model.material.density;
  const BondLaw law(s.model.contact, s.model.material, a, a);
  std::vector<std::string> lines;
  if (s.gas) lines = describe(*s.gas);
  lines.push_back(fmt::format("N = {} particles of {:g} nm in a droplet of {:g} nm, phi = {:.2f} % solids",
                              s.radius.size(), a * 1e9, R0 * 1e9, 100 * r.solids_fraction));
  if (s.smallest_radius() < s.largest_radius())
    lines.push_back(
        fmt::format("their radii lie between {:.4g} and {:.4g} nm; D, Pe and the time scales are those of {:g} nm",
                    s.smallest_radius() * 1e9, s.largest_radius() * 1e9, a * 1e9));
  lines.push_back(fmt::format(
      "liquid: mu = {:.4g} Pa s, sigma = {:.4g} N/m{}; D = {:.3g} m2/s", mu, s.surface_tension,
      s.contact_angle > 0 ? fmt::format(", {:.4g} of it pulls at the contact angle", wetting_factor(s.contact_angle))
                          : "",
      r.diffusivity));
  if (s.liquid.size() > 1)
    lines.push_back(fmt::format(
        "that is at half of the lifetime; it comes from {:.2f} K, mu = {:.4g} Pa s, and ends at {:.2f} K, mu "
        "= {:.4g} Pa s",
        s.liquid.front().temperature, s.liquid.front().viscosity, s.liquid.back().temperature,
        s.liquid.back().viscosity));
  lines.push_back(fmt::format("drying: tau = {:.4g} s, k = {:.4g} m2/s, Pe = {}", s.model.droplet.lifetime,
                              r.evaporation_constant,
                              std::isinf(r.peclet) ? "infinity" : fmt::format("{:.4g}", r.peclet)));
  if (s.model.crust_diffusivity < 1)
    lines.push_back(fmt::format(
        "second stage: the dry crust lets vapour through {:.3g} times as fast as the gas does; the "
        "liquid lives between {:.4g} and {:.4g} s",
        s.model.crust_diffusivity, s.model.droplet.lifetime, s.model.droplet.lifetime / s.model.crust_diffusivity));
  lines.push_back(
      fmt::format("the front recedes at {:.2g} m/s, {:.2g} m/s when the solids are packed; capillary force "
                  "moves a particle at up to sigma/(3 mu) = {:.2g} m/s",
                  r.front_speed, r.packed_front_speed, r.capillary_speed));
  lines.push_back(fmt::format("largest capillary force {:.3g} N = {:.2g} of the pull-off force {:.3g} N", force,
                              force / law.pull_off_force(), law.pull_off_force()));
  lines.push_back(fmt::format("time scales: inertia {:.2g} s, contact {:.2g} s, drying {:.2g} s",
                              m / drag_coefficient(mu, a), drag_coefficient(mu, a) / law.normal_stiffness(),
                              s.model.droplet.lifetime));
  if (const auto pair = outlooks(s)) {
    for (const auto& [look, name] :
         {std::pair{pair->first, "at the start"}, std::pair{pair->second, "when the solids are packed"}})
      for (const std::string& line : crumble::describe(look, name)) lines.push_back(line);
    lines.push_back(fmt::format(
        "half of the particles would meet another within {:.2g} s without repulsion, W times that with it",
        rapid_coagulation_half_time(mu, a, r.solids_fraction, s.model.surface_forces->electrolyte.thermal_energy)));
  }
  lines.push_back(r.words());
  const Expected expected = expected_shape(r);
  lines.push_back(fmt::format("expected shape: {}; {}", name_of(expected.shape), expected.why));
  lines.push_back(fmt::format("integrator: {}", integrator_text(s)));
  return lines;
}

void report_gas(Report& report, const GasSide& s) {
  const Gas& gas = s.gas.first();
  report.result("gas.temperature_k", gas.temperature);
  report.result("gas.vapour_mass_fraction", gas.vapour_mass_fraction);
  report.result("gas.relative_humidity", s.humidity);
  report.result("gas.pressure_pa", gas.pressure);
  report.result("gas.wet_bulb_k", s.wet_bulb);
  report.result("gas.last_wet_bulb_k", s.last_wet_bulb);
  report.result("gas.evaporation_constant_m2_per_s", s.evaporation_constant);
  report.result("gas.droplet_radius_m", s.droplet.radius);
  report.result("gas.largest_radius_m", s.largest_radius);
  report.result("gas.initial_temperature_k", s.droplet.temperature);
  report.result("gas.heat_up_time_s", s.heat_up_time);
  report.result("gas.lifetime_s", s.course.curve.lifetime());
  report.result("gas.vapour_knudsen_number", s.vapour_knudsen);
  report.result("gas.kelvin_excess", s.kelvin);
}

void report_regime(Report& report, const DryingScene& s) {
  const DryingRegime r = drying_regime(s);
  report.result("inputs.number", static_cast<std::int64_t>(s.radius.size()));
  report.result("inputs.solids_fraction", r.solids_fraction);
  report.result("inputs.viscosity_pa_s", s.model.viscosity);
  report.result("inputs.smallest_radius_nm", s.smallest_radius() * 1e9);
  report.result("inputs.largest_radius_nm", s.largest_radius() * 1e9);
  report.result("inputs.surface_tension_n_per_m", s.surface_tension);
  report.result("inputs.contact_angle_rad", s.contact_angle);
  report.result("inputs.diffusivity_m2_per_s", r.diffusivity);
  report.result("inputs.peclet", std::isinf(r.peclet) ? Report::Value(nullptr) : Report::Value(r.peclet));
  report.result("inputs.lifetime_s", s.model.droplet.lifetime);
  report.result("inputs.evaporation_constant_m2_per_s", r.evaporation_constant);
  report.result("inputs.front_speed_m_per_s", r.front_speed);
  report.result("inputs.capillary_speed_limit_m_per_s", r.capillary_speed);
  report.result("inputs.force_ratio", r.force_ratio);
  report.result("inputs.packed_front_over_capillary_speed", r.packed_front_speed / r.capillary_speed);
  if (const auto pair = outlooks(s)) {
    report_outlook(report, "surface_forces_at_start", pair->first);
    report_outlook(report, "surface_forces_packed", pair->second);
  }
  report.result("inputs.regime", r.words());
  if (s.gas) report_gas(report, *s.gas);
  report.result("inputs.integrator", integrator_text(s));
}

}  // namespace crumble::dryer
