#include "dryer/stand_in.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>

#include "common/io/progress.hpp"
#include "dryer/expected_cost.hpp"
#include "dryer/process_inputs.hpp"
#include "dryer/regime.hpp"
#include "dryer/scene.hpp"

namespace crumble::dryer {

namespace {

constexpr double fewest = 20;  // particles; fewer are no granule

// By which power of s the keys of size and speed change; others stay.
double power_of(const std::string& key, bool diffuses) {
  if (key == "droplet.radius") return 1;
  if (key == "droplet.lifetime") return diffuses ? 2 : 1;
  if (key == "droplet.evaporation_constant") return diffuses ? 0 : 1;
  if (key == "droplet.front_speed") return diffuses ? -1 : 0;
  return 0;
}

// As parsed from a scene that says only what this one says, changed.
std::string smaller(const Scene& scene, double number) {
  const double all = particle_number(scene), s = std::cbrt(number / all);
  const bool diffuses = scene.flag("particle.brownian_motion");
  std::string text;
  for (const Section& section : scene.table()) {
    std::string lines;
    if (section.repeated || section.name == "stands_for") continue;
    for (const Parameter& p : section.parameters) {
      const std::string key = section.name + "." + p.name;
      if (scene.origin(key) != Scene::Origin::given || !scene.is_set(key)) continue;
      ParameterValue value = *scene.value(key);
      if (const double power = power_of(key, diffuses); power != 0) value = scene.real(key) * std::pow(s, power);
      if (key == "particle.number") value = static_cast<std::int64_t>(std::llround(number));
      lines += fmt::format("{} = {}\n", p.name, toml_text(value));
    }
    if (!lines.empty()) text += fmt::format("\n[{}]\n{}", section.name, lines);
  }
  text += fmt::format("\n[stands_for]\nnumber = {}\n", toml_text(all));
  if (has_gas(scene))
    text += fmt::format("droplet_radius = {}\n",
                        toml_text(scene.is_set("stands_for.droplet_radius") ? scene.real("stands_for.droplet_radius")
                                                                            : scene.real("droplet.radius")));
  return text;
}

// What it names, a history of the gas, it finds where the scene does.
std::string name_beside(const Scene& scene) {
  return (std::filesystem::path(scene.file()).parent_path() / "the smaller scene").string();
}

std::string what_is_lost(const DryingRegime& r, double s) {
  const double real = r.front_speed * (std::isinf(r.peclet) ? 1 : s);
  std::string text = fmt::format(
      "# Lost: layers of particles: the real droplet is {:.3g} times as wide, its crust has more of them.\n", 1 / s);
  if (!std::isinf(r.peclet))
    text += fmt::format(
        "# Lost: front speed over capillary speed, at the start {:.2g} here and {:.2g} in the real droplet{}\n",
        r.front_speed / r.capillary_speed, real / r.capillary_speed,
        r.packed_front_speed > r.capillary_speed && real * r.packed_front_speed / r.front_speed < r.capillary_speed
            ? ": here the\n# front leaves particles dry at the end, there it would not. Take more particles."
            : ".");
  return text;
}

}  // namespace

FitTo fit_to(const std::string& text) {
  static const std::map<std::string, double> units{{"s", 1},     {"min", 60},    {"h", 3600},
                                                   {"d", 86400}, {"day", 86400}, {"days", 86400}};
  double value = 0;
  const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string unit(rest, text.data() + text.size());
  while (!unit.empty() && unit.front() == ' ') unit.erase(0, 1);
  const auto found = units.find(unit);
  const bool counts = unit.empty() && value >= fewest && value == std::floor(value);
  if (problem != std::errc() || !std::isfinite(value) || !(counts || (found != units.end() && value > 0)))
    throw InputError(
        fmt::format("--fit-to '{}': must be a number of particles from {:g}, or a time with its unit: \"30 min\", \"1 "
                    "h\", \"2 days\"",
                    text, fewest));
  if (counts) return {value, std::nullopt};
  return {std::nullopt, value * found->second};
}

std::string stand_in(const Scene& scene, double number) {
  const double all = particle_number(scene), s = std::cbrt(number / all);
  const std::string text = smaller(scene, number), name = name_beside(scene);
  const DryingScene small = drying_scene(Scene::parse(text, name, drying_parameters()));
  const DryingRegime r = drying_regime(small);
  std::string head =
      fmt::format("# {} particles that stand for the {:.3g} of {}.\n", small.radius.size(), all, scene.file());
  head += fmt::format(
      "# Kept: solids {:.3g} %, Pe = {}, capillary force over pull-off force {:.2g}{}.\n", 100 * r.solids_fraction,
      std::isinf(r.peclet) ? "infinity" : fmt::format("{:.3g}", r.peclet), r.force_ratio,
      std::isinf(r.peclet) ? fmt::format(", front speed over capillary speed {:.2g}", r.front_speed / r.capillary_speed)
                           : "");
  head += what_is_lost(r, s);
  return head + "# After the run the report says under `stands_for` what is known of the real granule.\n" + text;
}

std::string stand_in(const Scene& scene, const FitTo& wanted, const Machine& machine) {
  const double all = particle_number(scene);
  if (wanted.number) {
    if (*wanted.number >= all)
      throw InputError(
          fmt::format("--fit-to {:g}: the droplet has {:g} particles, it fits as it is", *wanted.number, all));
    return stand_in(scene, *wanted.number);
  }
  const auto seconds = [&](double number) {
    const Scene text = Scene::parse(smaller(scene, number), name_beside(scene), drying_parameters());
    const DryingScene small = drying_scene(text, machine);
    return expected_cost(small).most_seconds * (small.estimate_error ? 1.75 : 1);
  };
  // Beyond a million no time has been measured.
  double low = fewest, high = std::min(all, 1e6);
  if (seconds(low) > *wanted.seconds)
    throw InputError(fmt::format("--fit-to: {:g} particles of this droplet take up to {}; allow more time", low,
                                 duration_text(seconds(low))));
  while (high / low > 1.05) {
    const double middle = std::sqrt(low * high);
    (seconds(middle) > *wanted.seconds ? high : low) = middle;
  }
  if (low > 0.9 * all)
    throw InputError(fmt::format("--fit-to: the droplet of {:g} particles dries in that time as it is", all));
  return stand_in(scene, std::round(low));
}

namespace {

// How a number changes from N to N' particles beyond its scaling: it is between these powers of N'/N, the first up to
// 1000 particles, the second beyond. All are of dryer/MODEL.md, "Scaling up".
struct Growth {
  double low, high, low_beyond, high_beyond;
  std::array<double, 2> factors(double from, double to) const {
    const double few = std::max(std::min(to, 1000.0) / from, 1.0), many = to / std::max(from, std::min(to, 1000.0));
    return {std::pow(few, low) * std::pow(many, low_beyond), std::pow(few, high) * std::pow(many, high_beyond)};
  }
};
constexpr Growth hollow_d_c{0, 0.05, 0, 0.02}, hollow_coordination{0, 0.11, 0, 0.01};
constexpr Growth compact_d_c{-0.05, 0, -0.05, 0}, compact_coordination{0, 0.05, 0, 0.05};

}  // namespace

RealGranule real_granule(const DryingScene& scene, const Morphology& m) {
  RealGranule real;
  const double N = static_cast<double>(scene.radius.size());
  real.number = *scene.stands_for;
  const bool diffuses = scene.model.thermal_energy > 0;
  auto d_c = (diffuses ? compact_d_c : hollow_d_c).factors(N, real.number);
  // However far it is extrapolated: no denser than equal spheres pack at random (0.64; Scott & Kilgour 1969).
  d_c[0] = std::max(d_c[0], std::min(1.0, std::cbrt((1 - m.porosity) / 0.64)));
  const auto coordination = (diffuses ? compact_coordination : hollow_coordination).factors(N, real.number);
  const double size = std::cbrt(real.number / N);
  for (const std::size_t k : {0, 1}) {
    real.d_c[k] = size * d_c[k] * m.extent.diameter();
    real.coordination[k] = coordination[k] * m.coordination;
    // The volume of the particles, over that of a sphere which grows by d_c.
    real.porosity[k] = 1 - (1 - m.porosity) / std::pow(d_c[k], 3);
  }
  real.known = diffuses ? "measured at Pe = 10 from 43 to 340 particles; elsewhere not known, this is extrapolated"
               : real.number <= 1e5
                   ? "measured without Brownian motion from 30 to 100,000 particles"
                   : "measured without Brownian motion from 30 to 100,000 particles, extrapolated beyond";
  return real;
}

std::string real_granule_text(const DryingScene& scene, const Morphology& m) {
  if (!scene.stands_for) return "";
  const RealGranule r = real_granule(scene, m);
  return fmt::format(
      "stands for    {:.3g} particles: d_c {:.3g} to {:.3g} um, porosity {:.2f} to {:.2f}, coordination {:.2f} to "
      "{:.2f} ({}). "
      "Shape as found here. Strength: that of these particles; how it changes with their number is not known\n",
      r.number, 1e6 * r.d_c[0], 1e6 * r.d_c[1], r.porosity[0], r.porosity[1], r.coordination[0], r.coordination[1],
      r.known);
}

void report_real_granule(Report& report, const DryingScene& scene, const Morphology& m) {
  if (!scene.stands_for) return;
  const RealGranule r = real_granule(scene, m);
  const auto list = [](const std::array<double, 2>& x, double unit) {
    return std::vector<double>{unit * x[0], unit * x[1]};
  };
  report.result("stands_for.number", r.number);
  report.result("stands_for.d_c_nm", list(r.d_c, 1e9));
  report.result("stands_for.porosity", list(r.porosity, 1));
  report.result("stands_for.coordination", list(r.coordination, 1));
  report.result("stands_for.strength", nullptr);
  report.result("stands_for.known", r.known);
}

}  // namespace crumble::dryer
