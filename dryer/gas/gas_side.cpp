#include "dryer/gas/gas_side.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/io/plausible.hpp"
#include "common/text/csv.hpp"
#include "dryer/gas/small_droplet.hpp"
#include "dryer/gas/water_saturation.hpp"
#include "dryer/water_surface_tension.hpp"

namespace crumble::dryer {

using P = Parameter;

Section gas_section() {
  return {
      "gas",
      "The gas around a droplet of water. With it R(t) and the droplet's temperature follow from the laws of "
      "evaporation, and lifetime, evaporation_constant, front_speed and peclet of [droplet] are not given; where "
      "[fluid] does not say otherwise, the "
      "liquid is water at the droplet's temperature.",
      {P::real("temperature", "K", "Temperature of the gas").above(0).optional(),
       P::real("relative_humidity", "",
               "Partial pressure of the vapour in that of saturation at gas.temperature; exactly one of this key "
               "and the next three")
           .or_by("relative_humidity_percent", 0.01)
           .at_least(0)
           .optional(),
       P::real("vapour_mass_fraction", "", "Absolute humidity: kg of vapour in 1 kg of moist gas")
           .at_least(0)
           .below(1)
           .optional(),
       P::real("humidity_ratio", "", "Absolute humidity: kg of vapour to 1 kg of dry gas").at_least(0).optional(),
       P::real("dew_point", "K", "Temperature at which the vapour is saturated").above(0).optional(),
       P::real("pressure", "Pa", "Pressure of the gas").above(0).by_default(101325),
       P::real("slip", "m s-1", "Speed of the droplet against the gas; small droplets follow it: 0")
           .at_least(0)
           .by_default(0),
       P::text("history",
               "CSV file of the gas that a droplet meets, as seen from the scene, in place of temperature, humidity "
               "and slip: columns t [s], temperature [K], vapour_mass_fraction and, if it slips, slip [m/s]; after "
               "the last row the gas stays as it is")
           .optional()}};
}

Parameter initial_temperature_parameter() {
  return P::real("initial_temperature", "K",
                 "Of the droplet at the start; only with [gas]. Without it the wet bulb of the gas in which it starts")
      .above(0)
      .optional();
}

Parameter real_radius_parameter() {
  return P::real("droplet_radius", "m",
                 "Its radius; only with [gas]. Gas and heat are then those of the real droplet, and R(t)/R0 is its own "
                 "in its time times (R0/R0_real)^2 with Brownian motion, which keeps k and Pe, else times R0/R0_real")
      .above(0)
      .optional();
}

bool has_gas(const Scene& scene) {
  for (const Parameter& p : gas_section().parameters) {
    const std::string key = "gas." + p.name;
    if (scene.is_set(key) && scene.origin(key) != Scene::Origin::by_default) return true;
  }
  return false;
}

std::string gas_key(const Scene& scene) { return scene.is_set("gas.history") ? "gas.history" : "gas.temperature"; }

std::vector<ReadFile> gas_files(const Scene& scene) {
  if (!scene.is_set("gas.history")) return {};
  const auto file = std::filesystem::path(scene.file()).parent_path() / scene.text("gas.history");
  return {{"the history of the gas", file.string()}};
}

void inherit_from_gas(Scene& scene) {
  if (!has_gas(scene)) return;
  for (const char* key : {"fluid.viscosity", "fluid.surface_tension"})
    scene.inherit(key, std::string("water"), "[gas]");
}

namespace {

constexpr const char* humidities[]{"gas.relative_humidity", "gas.vapour_mass_fraction", "gas.humidity_ratio",
                                   "gas.dew_point"};

[[noreturn]] void fog(const Scene& scene, const std::string& key, double T, double pressure) {
  const double most = saturation_pressure(T);
  throw scene.error(
      key,
      fmt::format("is below its dew point: vapour in it condenses to fog, and no droplet dries. At gas.temperature "
                  "= {:g} K ({}) at most gas.vapour_mass_fraction = {:.4g}, a dew point of {:g} K, is possible; "
                  "give less humidity or a warmer gas",
                  T, scene.where("gas.temperature"), mass_fraction_at(most, pressure), T));
}

// Partial pressure of the vapour by the one key that says it, Pa.
double vapour_pressure_given(const Scene& scene, const std::string& key, double T, double pressure) {
  const double value = scene.real(key);
  if (key == "gas.relative_humidity") {
    if (value > 1)
      throw scene.error(key, fmt::format("must be at most 1, saturated gas{}",
                                         value <= 100 ? fmt::format("; if per cent were meant, write {:g}, or "
                                                                    "gas.relative_humidity_percent = {:g}",
                                                                    value / 100, value)
                                                      : ""));
    if (T >= water_critical_temperature) throw scene.error(key, "has no meaning in so hot a gas: give its dew point");
    return value * saturation_pressure(T);
  }
  if (key == "gas.dew_point") {
    if (value > T && value < water_critical_temperature) fog(scene, key, T, pressure);
    if (value >= water_critical_temperature) throw scene.error(key, "is above the critical point of water");
    return saturation_pressure(value);
  }
  const double Y = key == "gas.humidity_ratio" ? value / (1 + value) : value;
  return vapour_mole_fraction(Y) * pressure;
}

Gas constant_gas(const Scene& scene) {
  if (!scene.is_set("gas.temperature"))
    throw InputError(fmt::format("{}: [gas] needs gas.temperature, or gas.history", scene.file()));
  require_temperature(scene, "gas.temperature");
  std::string found;
  for (const char* key : humidities) {
    if (!scene.is_set(key)) continue;
    if (!found.empty())
      throw scene.error(key, fmt::format("the humidity is already given by {} ({}); remove one of the two", found,
                                         scene.where(found)));
    found = key;
  }
  if (found.empty())
    throw scene.error("gas.temperature",
                      "needs the humidity of the gas; give one of gas.relative_humidity, gas.vapour_mass_fraction, "
                      "gas.humidity_ratio, gas.dew_point (dry gas: gas.vapour_mass_fraction = 0)");
  const double T = scene.real("gas.temperature"), p = scene.real("gas.pressure");
  const double vapour = vapour_pressure_given(scene, found, T, p);
  if (!(vapour < p))
    throw scene.error(found, fmt::format("the vapour alone would have {:.4g} Pa, more than gas.pressure = {:g} Pa ({})",
                                         vapour, p, scene.where("gas.pressure")));
  const Gas gas{T, mass_fraction_at(vapour, p), scene.real("gas.slip"), p};
  if (relative_humidity(gas) > 1 + 1e-9) fog(scene, found, T, p);
  if (relative_humidity(gas) >= 1 - 1e-9)
    throw scene.error(found, "the gas is saturated with vapour: a droplet does not dry in it; give less humidity");
  return gas;
}

GasHistory history_in(const Scene& scene) {
  for (const char* key : {"gas.temperature", "gas.relative_humidity", "gas.vapour_mass_fraction", "gas.humidity_ratio",
                          "gas.dew_point", "gas.slip"})
    if (scene.is_set(key) && scene.origin(key) != Scene::Origin::by_default)
      throw scene.error(key, fmt::format("the gas is already given by gas.history ({}); remove one of the two",
                                         scene.where("gas.history")));
  const std::string file = gas_files(scene).front().name;
  try {
    return read_gas_history(text::whole_file(file), file, scene.real("gas.pressure"));
  } catch (const text::UnreadableError& error) {
    throw scene.error("gas.history", std::string("the file ") + error.what());
  }
}

double initial_temperature(const Scene& scene, const GasHistory& gas, double R0) {
  if (!scene.is_set("droplet.initial_temperature")) return wet_bulb(R0, gas.first());
  require_temperature(scene, "droplet.initial_temperature");
  const double T = scene.real("droplet.initial_temperature");
  if (T < water_triple_point || !(saturation_pressure(T) < gas.first().pressure))
    throw scene.error("droplet.initial_temperature",
                      fmt::format("water is liquid between {} and {:.2f} K at gas.pressure", water_triple_point,
                                  saturation_temperature(gas.first().pressure)));
  return T;
}

std::string unit_of(std::string_view name) {
  const auto open = name.find('['), close = name.find(']');
  if (open == name.npos || close == name.npos || close < open) return "";
  return std::string(text::trimmed(name.substr(open + 1, close - open - 1)));
}

}  // namespace

GasHistory read_gas_history(const std::string& content, const std::string& file, double pressure) try {
  const std::string expected = "t [s], temperature [K], vapour_mass_fraction, slip [m/s]";
  text::Csv csv(content, file, expected);
  const auto where = [&] { return fmt::format("{}:{}", file, csv.lines().number()); };
  const std::vector<std::string> names[]{{"t", "time"}, {"temperature"}, {"vapour_mass_fraction"}, {"slip"}};
  const std::vector<std::string> units[]{{"s"}, {"K"}, {"-", "1", "kg/kg"}, {"m/s", "m s-1"}};
  std::size_t column[4];
  std::fill(column, column + 4, csv.names().size());
  for (std::size_t k = 0; k < csv.names().size(); ++k) {
    const std::string_view name = csv.names()[k];
    const std::string word = text::lower(text::trimmed(name.substr(0, name.find('[')))), unit = unit_of(name);
    std::size_t what = 0;
    while (what < 4 && std::find(names[what].begin(), names[what].end(), word) == names[what].end()) ++what;
    if (what == 4) throw InputError(fmt::format("{}: column {} '{}' is none of {}", where(), k + 1, name, expected));
    if (column[what] < csv.names().size()) throw InputError(fmt::format("{}: '{}' stands twice", where(), word));
    if (!unit.empty() && std::find(units[what].begin(), units[what].end(), unit) == units[what].end())
      throw InputError(fmt::format("{}: '{}': the unit must be {}", where(), name, units[what].front()));
    column[what] = k;
  }
  for (const std::size_t what : {0, 1, 2})
    if (column[what] == csv.names().size())
      throw InputError(
          fmt::format("{}: the column '{}' is missing; there must be {}", where(), names[what].front(), expected));
  std::vector<double> times;
  std::vector<Gas> gas;
  while (csv.next()) {
    const double t = csv.number(column[0]);
    const Gas row{csv.number(column[1]), csv.number(column[2]),
                  column[3] < csv.names().size() ? csv.number(column[3]) : 0, pressure};
    if (times.empty() && t != 0)
      throw InputError(fmt::format("{}: the first time is {:g} s; a history begins at t = 0", where(), t));
    if (!times.empty() && t <= times.back())
      throw InputError(
          fmt::format("{}: time {:g} s does not follow {:g} s: times must increase", where(), t, times.back()));
    if (const std::string wrong = temperature_complaint(row.temperature); !wrong.empty())
      throw InputError(fmt::format("{}: temperature: {}", where(), wrong));
    if (!(row.vapour_mass_fraction >= 0 && row.vapour_mass_fraction < 1))
      throw InputError(
          fmt::format("{}: vapour_mass_fraction = {:g}: must be at least 0 and below 1, kg of vapour per kg "
                      "of moist gas",
                      where(), row.vapour_mass_fraction));
    if (row.slip < 0) throw InputError(fmt::format("{}: slip = {:g} m/s: must be at least 0", where(), row.slip));
    if (relative_humidity(row) > 1 + 1e-9)
      throw InputError(fmt::format(
          "{}: the gas of {:g} K is below its dew point, {:.2f} K: vapour in it condenses to fog; the vapour mass "
          "fraction can be at most {:.4g} there",
          where(), row.temperature, dew_point(row), mass_fraction_at(saturation_pressure(row.temperature), pressure)));
    times.push_back(t);
    gas.push_back(row);
  }
  if (times.empty()) throw InputError(file + ": a history needs a header and at least one instant");
  return {std::move(times), std::move(gas)};
} catch (const text::TextError& error) {
  throw InputError(error.what());
}

GasSide gas_side(const Scene& scene) {
  const GasHistory gas = scene.is_set("gas.history") ? history_in(scene) : GasHistory(constant_gas(scene));
  const double R0 = scene.real("droplet.radius");
  EvaporatingDroplet droplet;
  droplet.radius = R0;
  if (scene.is_set("stands_for.droplet_radius")) {
    droplet.radius = scene.real("stands_for.droplet_radius");
    if (droplet.radius < R0)
      throw scene.error("stands_for.droplet_radius",
                        fmt::format("is smaller than droplet.radius = {:g} m ({}), which stands for it", R0,
                                    scene.where("droplet.radius")));
  }
  droplet.last_radius = std::max(1e-3 * droplet.radius, scene.real("particle.radius"));
  if (droplet.last_radius >= droplet.radius)
    throw scene.error("particle.radius", fmt::format("does not fit into droplet.radius = {:g} m", droplet.radius));
  try {
    droplet.temperature = initial_temperature(scene, gas, droplet.radius);
    Evaporation course = evaporation(droplet, gas);
    GasSide s{gas, droplet, course, R0 / droplet.radius, 1, nullptr};
    s.pace = scene.flag("particle.brownian_motion") ? s.size * s.size : s.size;
    s.curve = std::make_shared<const DryingCurve>(course.curve.scaled(s.size, s.pace));
    s.wet_bulb = wet_bulb(droplet.radius, gas.first());
    s.last_wet_bulb = wet_bulb(droplet.radius, gas.last());
    s.evaporation_constant =
        evaporation_constant(film_of(droplet.radius, s.wet_bulb, gas.first()), droplet.radius, s.wet_bulb);
    s.humidity = relative_humidity(gas.first()), s.dew = dew_point(gas.first());
    const double T_film = s.wet_bulb + (gas.first().temperature - s.wet_bulb) / 3;
    const MoistAir film = moist_air(T_film, gas.first().pressure, gas.first().vapour_mass_fraction);
    s.heat_up_time = heat_up_time(droplet.radius, s.wet_bulb, film.conductivity);
    s.vapour_knudsen = vapour_free_path(film.diffusivity, T_film) / droplet.radius;
    s.kelvin = kelvin_factor(water_surface_tension(s.wet_bulb), saturated_water_density(s.wet_bulb), s.wet_bulb,
                             droplet.radius) -
               1;
    for (const auto& node : course.curve.nodes()) s.largest_radius = std::max(s.largest_radius, std::sqrt(node.square));
    return s;
  } catch (const std::domain_error& wrong) {
    throw scene.error(gas_key(scene), fmt::format("{}; give a gas that is {}", wrong.what(),
                                                  std::string_view(wrong.what()).find("freez") != std::string_view::npos
                                                      ? "warmer or more humid"
                                                      : "drier or warmer, and below the boiling of the droplet"));
  }
}

std::vector<std::string> describe(const GasSide& s) {
  constexpr double ice = 273.15;
  const Gas& g = s.gas.first();
  std::vector<std::string> lines;
  lines.push_back(fmt::format(
      "gas: {:.4g} K ({:.4g} C), {:.4g} Pa, vapour mass fraction {:.4g} (relative humidity {:.3g} %{}){}{}",
      g.temperature, g.temperature - ice, g.pressure, g.vapour_mass_fraction, 100 * s.humidity,
      g.vapour_mass_fraction > 0 ? fmt::format(", dew point {:.2f} K", s.dew) : "",
      g.slip > 0 ? fmt::format(", slip {:g} m/s", g.slip) : "",
      s.gas.times().size() > 1 ? fmt::format(" at the start of a history of {:g} s", s.gas.times().back()) : ""));
  lines.push_back(
      fmt::format("droplet in it: wet bulb {:.2f} K ({:.2f} C), k = {:.4g} m2/s there; it starts at {:.2f} K, warms up "
                  "within {:.2g} "
                  "s and is dry after {:.4g} s",
                  s.wet_bulb, s.wet_bulb - ice, s.evaporation_constant, s.droplet.temperature, s.heat_up_time,
                  s.course.curve.lifetime()));
  if (s.largest_radius > s.droplet.radius * (1 + 1e-9))
    lines.push_back(fmt::format(
        "at the start the droplet, {:.2f} K, is colder than the dew point of the gas: vapour condenses on it, and its "
        "radius grows by {:.2g} % before it dries",
        s.droplet.temperature, 100 * (s.largest_radius / s.droplet.radius - 1)));
  if (s.vapour_knudsen > 0.01 || s.kelvin > 0.001)
    lines.push_back(fmt::format(
        "a small droplet: mean free path of the vapour over radius {:.2g}, vapour pressure raised by {:.2g} % "
        "(Kelvin); both are taken into account",
        s.vapour_knudsen, 100 * s.kelvin));
  if (s.size < 1)
    lines.push_back(
        fmt::format("gas and heat are those of the real droplet of {:.4g} um for which this one stands, its times "
                    "multiplied by {:.3g}",
                    1e6 * s.droplet.radius, s.pace));
  return lines;
}

}  // namespace crumble::dryer
