#include "dryer/conditions.hpp"

#include <fmt/core.h>

#include <cmath>

#include "common/io/plausible.hpp"
#include "dryer/drag.hpp"
#include "dryer/outcome.hpp"
#include "dryer/scene.hpp"

namespace crumble::dryer {

namespace {

double diffusivity_at(const Conditions& c, double time) {
  const LiquidPiece& liquid = piece_at(c.process.liquid, time);
  return diffusivity(liquid.temperature, liquid.viscosity, c.particle);
}

struct Row {
  double time, radius, temperature, evaporation_constant, peclet;
};

std::vector<Row> rows(const Conditions& c) {
  std::vector<Row> rows;
  for (const auto& node : c.process.gas->curve->nodes())
    rows.push_back({node.time, std::sqrt(node.square), node.temperature, -node.square_slope,
                    -node.square_slope / diffusivity_at(c, node.time)});
  return rows;
}

std::string line(const std::string& what, const std::string& value) { return fmt::format("{:<34}{}\n", what, value); }

std::string shape_text(const DryingRegime& regime) {
  const Expected expected = expected_shape(regime);
  return fmt::format("{} ({})", name_of(expected.shape), expected.why);
}

}  // namespace

Conditions conditions(const Scene& scene, double fewer) {
  if (!has_gas(scene))
    throw InputError(
        fmt::format("{}: dryer conditions needs the gas; give gas.temperature and one of "
                    "gas.relative_humidity, gas.vapour_mass_fraction, gas.humidity_ratio, gas.dew_point, or "
                    "gas.history",
                    scene.file()));
  require_radius(scene, "particle.radius");
  Conditions c;
  c.process = inputs_without_particles(scene);
  c.radius = scene.real("droplet.radius"), c.particle = scene.real("particle.radius");
  const double tau = c.process.lifetime;
  c.diffusivity = diffusivity_at(c, 0.5 * tau);
  c.peclet = c.radius * c.radius / (tau * c.diffusivity);
  if (!says_number(scene)) return c;
  c.number = particle_number(scene);
  c.solids_fraction = *c.number * std::pow(c.particle / c.radius, 3);
  DryingModel model = drying_model(scene, c.process);
  model.thermal_energy = boltzmann_constant * piece_at(c.process.liquid, 0.5 * tau).temperature;
  c.regime = drying_regime(model, c.particle, *c.solids_fraction);
  c.packed_time = model.droplet.time_at(c.radius * std::cbrt(std::fmin(2 * *c.solids_fraction, 1)));
  if (fewer < *c.number) {
    const double s = std::cbrt(fewer / *c.number), pace = s * s;
    model.droplet.curve = std::make_shared<const DryingCurve>(c.process.gas->curve->scaled(s, pace));
    model.droplet.initial_radius *= s, model.droplet.lifetime *= pace;
    c.smaller = {fewer, s * c.radius, pace * tau, drying_regime(model, c.particle, *c.solids_fraction)};
  }
  return c;
}

std::string conditions_table(const Conditions& c) {
  constexpr double ice = 273.15;
  const GasSide& g = *c.process.gas;
  const double tau = c.process.lifetime;
  const LiquidPiece& liquid = piece_at(c.process.liquid, 0.5 * tau);
  std::string text;
  text +=
      line("gas", fmt::format("{:.2f} C, vapour mass fraction {:.4g}, relative humidity {:.3g} %",
                              g.gas.first().temperature - ice, g.gas.first().vapour_mass_fraction, 100 * g.humidity));
  if (g.gas.first().vapour_mass_fraction > 0) text += line("dew point", fmt::format("{:.2f} C", g.dew - ice));
  text += line("wet bulb", fmt::format("{:.2f} C", g.wet_bulb - ice));
  if (g.gas.times().size() > 1)
    text += line("wet bulb at the end of the history", fmt::format("{:.2f} C", g.last_wet_bulb - ice));
  text += line("droplet",
               fmt::format("{:.4g} um in radius, {:.2f} C at the start", 1e6 * c.radius, g.droplet.temperature - ice));
  if (g.size < 1)
    text += line("  which stands for one of", fmt::format("{:.4g} um, dry after {:.4g} s: gas and heat are its",
                                                          1e6 * g.droplet.radius, g.course.curve.lifetime()));
  if (g.largest_radius > g.droplet.radius * (1 + 1e-9))
    text += line("condensation at first",
                 fmt::format("the radius grows by {:.2g} %", 100 * (g.largest_radius / g.droplet.radius - 1)));
  text += line("warms up within", fmt::format("{:.2g} s", g.heat_up_time * g.pace));
  text += line("dry after", fmt::format("{:.4g} s", tau));
  text += line("k at the wet bulb", fmt::format("{:.4g} m2/s", g.evaporation_constant));
  text += line("k, mean over the lifetime", fmt::format("{:.4g} m2/s", c.radius * c.radius / tau));
  text +=
      line("liquid at half of that", fmt::format("{:.2f} C, mu = {:.4g} Pa s, sigma = {:.4g} N/m",
                                                 liquid.temperature - ice, liquid.viscosity, liquid.surface_tension));
  text += line("D of a particle", fmt::format("{:.4g} m2/s, {:.4g} nm in radius", c.diffusivity, 1e9 * c.particle));
  text += line("Pe = k/D", fmt::format("{:.4g}", c.peclet));
  if (!c.regime)
    return text + "particle.number, .solids_fraction or .weight_fraction would say which granule to expect\n";
  text += line("particles", fmt::format("{:.4g}, {:.3g} % solids; packed after {:.4g} s", *c.number,
                                        100 * *c.solids_fraction, c.packed_time));
  text += line("regime", c.regime->words());
  text += line("expected shape", shape_text(*c.regime));
  if (!c.smaller) return text;
  const auto& s = *c.smaller;
  text +=
      line(fmt::format("{:g} particles stand for it", s.number),
           fmt::format("{:.4g} nm in radius, dry after {:.4g} s (with Brownian motion)", 1e9 * s.radius, s.lifetime));
  text +=
      line("  kept", fmt::format("particles, bonds, liquid, solids, k, Pe = {:.4g}, R/R0 and temperature at the same "
                                 "share of the lifetime",
                                 s.regime.peclet));
  text +=
      line("  lost", fmt::format("layers of particles (the real droplet is {:.3g} times as wide); front over capillary "
                                 "speed where packed {:.2g}, in the real droplet {:.2g}",
                                 c.radius / s.radius, s.regime.packed_front_speed / s.regime.capillary_speed,
                                 c.regime->packed_front_speed / c.regime->capillary_speed));
  text += line("  expected shape", shape_text(s.regime));
  return text;
}

std::string conditions_csv(const Conditions& c) {
  std::string text = "time_s,radius_m,temperature_k,evaporation_constant_m2_per_s,peclet\n";
  for (const Row& r : rows(c))
    text += fmt::format("{:.12g},{:.12g},{:.12g},{:.9g},{:.9g}\n", r.time, r.radius, r.temperature,
                        r.evaporation_constant, r.peclet);
  return text;
}

void fill_report(Report& report, const Conditions& c) {
  report_gas(report, *c.process.gas);
  report.result("lifetime_s", c.process.lifetime);
  report.result("diffusivity_m2_per_s", c.diffusivity);
  report.result("peclet", c.peclet);
  if (c.regime) {
    report.result("number", *c.number);
    report.result("solids_fraction", *c.solids_fraction);
    report.result("packed_time_s", c.packed_time);
    report.result("regime", c.regime->words());
    report.result("expected_shape", std::string(name_of(expected_shape(*c.regime).shape)));
    report.result("packed_front_over_capillary_speed", c.regime->packed_front_speed / c.regime->capillary_speed);
    report.result("capillary_over_pull_off_force", c.regime->force_ratio);
  }
  if (c.smaller) {
    report.result("smaller.number", c.smaller->number);
    report.result("smaller.radius_m", c.smaller->radius);
    report.result("smaller.lifetime_s", c.smaller->lifetime);
    report.result("smaller.peclet", c.smaller->regime.peclet);
    report.result("smaller.packed_front_over_capillary_speed",
                  c.smaller->regime.packed_front_speed / c.smaller->regime.capillary_speed);
  }
  std::vector<double> time, radius, temperature;
  for (const Row& r : rows(c)) time.push_back(r.time), radius.push_back(r.radius), temperature.push_back(r.temperature);
  report.result("course.time_s", time);
  report.result("course.radius_m", radius);
  report.result("course.temperature_k", temperature);
}

}  // namespace crumble::dryer
