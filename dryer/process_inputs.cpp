#include "dryer/process_inputs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dryer/drag.hpp"
#include "dryer/particle_radii.hpp"
#include "dryer/water_surface_tension.hpp"
#include "dryer/water_viscosity.hpp"

namespace crumble::dryer {

namespace {

// The one of several keys that is set; none or two of them is an error.
std::string only_one_of(const Scene& scene, const std::vector<std::string>& keys, const std::string& what,
                        const std::string& or_else = "") {
  std::string found, all;
  for (const std::string& key : keys) {
    all += (all.empty() ? "" : ", ") + key;
    if (!scene.is_set(key)) continue;
    if (!found.empty())
      throw scene.error(
          key, fmt::format("{} is already given by {} ({}); remove one of the two", what, found, scene.where(found)));
    found = key;
  }
  if (found.empty())
    throw InputError(fmt::format("{}: {} is missing; give one of {}{}", scene.file(), what, all, or_else));
  return found;
}

// A parameter that only some distribution has: there it is required, elsewhere it has no meaning.
double of_distribution(const Scene& scene, const std::string& key, const std::string& distribution) {
  const std::string& chosen = scene.choice("particle.distribution");
  if (chosen == distribution && !scene.is_set(key))
    throw scene.error("particle.distribution", fmt::format("needs {}", key));
  if (chosen != distribution && scene.is_set(key))
    throw scene.error(key, fmt::format("has a meaning only with particle.distribution = \"{}\"", distribution));
  return chosen == distribution ? scene.real(key) : 0;
}

RadiusDistribution radius_distribution(const Scene& scene) {
  using Kind = RadiusDistribution::Kind;
  const std::string& chosen = scene.choice("particle.distribution");
  return {chosen == "lognormal" ? Kind::lognormal
          : chosen == "bimodal" ? Kind::bimodal
                                : Kind::equal,
          scene.real("particle.radius"), of_distribution(scene, "particle.geometric_standard_deviation", "lognormal"),
          of_distribution(scene, "particle.second_radius", "bimodal"),
          of_distribution(scene, "particle.second_share", "bimodal")};
}

// Before the first array of this size is asked for.
void refuse_beyond_memory(const Scene& scene, const std::string& key, double number, const Machine& machine) {
  if (memory_of(number) <= machine.memory) return;
  throw scene.error(
      key,
      fmt::format("means {:.3g} particles, which take {:.2g} GB of memory; {:.2g} GB are free here. "
                  "Take at most {:.2g} particles, or another machine; --fit-to N prints a smaller droplet that stands "
                  "for this one",
                  number, 1e-9 * memory_of(number), 1e-9 * machine.memory,
                  std::max(number * machine.memory / memory_of(number), 1.0)));
}

constexpr const char* numbers[]{"particle.number", "particle.solids_fraction", "particle.weight_fraction"};

std::string number_key(const Scene& scene) {
  return only_one_of(scene, {numbers, numbers + 3}, "the number of particles");
}

// Of the volume of the droplet. From a share w of its weight: w/rho_p over w/rho_p + (1 - w)/rho.
double solids_given(const Scene& scene, const std::string& key) {
  const double share = scene.real(key);
  if (key == "particle.solids_fraction") return share;
  if (scene.origin("material.density") == Scene::Origin::by_default)
    throw scene.error(key, "needs material.density, the density of the particles in kg m-3");
  return volume_fraction(share, scene.real("material.density"), scene.real("fluid.density"));
}

std::vector<double> particle_radii(const Scene& scene, const Machine& machine) {
  const double a = scene.real("particle.radius"), R0 = scene.real("droplet.radius");
  const RadiusDistribution distribution = radius_distribution(scene);
  for (const char* key : {"particle.radius", "particle.second_radius"})
    if (scene.is_set(key) && scene.real(key) >= R0)
      throw scene.error(
          key, fmt::format("no particle fits into droplet.radius = {:g} m ({})", R0, scene.where("droplet.radius")));
  const std::string key = number_key(scene);
  const double capacity = std::pow(R0 / a, 3);  // N at 100 % solids
  const bool counted = key == "particle.number";
  const double number = particle_number(scene);
  if (number < 1)
    throw scene.error(key, fmt::format("is less than one particle; one alone is a fraction of {:.3g}", 1 / capacity));
  // Random sequential addition jams at 38 % of the volume that centres can take; long before that it crawls.
  const auto refuse = [&](double fraction) {
    throw scene.error(key, fmt::format("fills {:.0f} % of the droplet with solids; a random start is possible up to "
                                       "30 %, that is {:.0f} particles",
                                       100 * fraction, 0.3 * number / fraction));
  };
  const bool equal = distribution.kind == RadiusDistribution::Kind::equal;
  if ((equal || !counted) && number > 0.3 * capacity) refuse(number / capacity);
  if (number > 2147483647)
    throw scene.error(key, fmt::format("means {:.3g} particles; they are numbered up to 2147483647", number));
  refuse_beyond_memory(scene, key, number, machine);
  const auto seed = static_cast<std::uint64_t>(scene.integer("run.seed"));
  std::vector<double> radius = counted ? radii_by_number(distribution, static_cast<std::size_t>(number), seed)
                                       : radii_by_volume(distribution, solids_given(scene, key) * R0 * R0 * R0, seed);
  double solids = 0;
  for (const double each : radius) solids += each * each * each / (R0 * R0 * R0);
  if (radius.empty()) throw scene.error(key, "is less than one particle");
  if (solids > 0.3) refuse(solids);
  if (radius.front() >= R0)
    throw scene.error("particle.geometric_standard_deviation",
                      fmt::format("draws a particle of {:.3g} m, which does not fit into droplet.radius = {:g} m",
                                  radius.front(), R0));
  return radius;
}

// The number, or water's law at the temperature of the scene.
double liquid_property(const Scene& scene, const std::string& key, double (*water)(double), double from, double to) {
  if (!scene.word(key)) return scene.real(key);
  const double temperature = scene.real("fluid.temperature");
  if (temperature < from || temperature > to)
    throw scene.error("fluid.temperature",
                      fmt::format("{} = \"water\" ({}) is known from {} to {} K; give a temperature in between or a "
                                  "number for {}",
                                  key, scene.where(key), from, to, key));
  return water(temperature);
}

constexpr const char* speeds[]{"droplet.lifetime", "droplet.evaporation_constant", "droplet.front_speed",
                               "droplet.peclet"};

// What [gas] says may not be said again.
void refuse_beside_gas(const Scene& scene) {
  const std::string gas = gas_key(scene);
  const std::string where = scene.is_set(gas) ? fmt::format("{} ({})", gas, scene.where(gas)) : "[gas]";
  for (const char* key : speeds)
    if (scene.is_set(key))
      throw scene.error(key, fmt::format("the speed of drying is already given by {}; remove one of the two", where));
  if (scene.origin("fluid.temperature") != Scene::Origin::by_default)
    throw scene.error("fluid.temperature",
                      fmt::format("the temperature of the droplet follows from {}; remove one of the two, or give "
                                  "droplet.initial_temperature",
                                  where));
}

void refuse_without_gas(const Scene& scene) {
  for (const char* key : {"droplet.initial_temperature", "stands_for.droplet_radius"})
    if (scene.is_set(key))
      throw scene.error(key, "has a meaning only with [gas]; give gas.temperature and a humidity, or remove it");
}

// Unless the scene gives a number, water's (inherit_from_gas()).
double liquid_property_at(const Scene& scene, const std::string& key, double (*water)(double), double temperature) {
  if (!scene.word(key) && scene.origin(key) != Scene::Origin::by_default) return scene.real(key);
  try {
    return water(temperature);
  } catch (const std::domain_error& wrong) {
    throw scene.error(gas_key(scene), fmt::format("makes the droplet {:.1f} K; {}; give a number for {}", temperature,
                                                  wrong.what(), key));
  }
}

void add_gas(const Scene& scene, ProcessInputs& p) {
  refuse_beside_gas(scene);
  p.gas = std::make_shared<const GasSide>(gas_side(scene));
  const bool diffuses = scene.flag("particle.brownian_motion");
  p.liquid = liquid_course(*p.gas->curve, [&](LiquidPiece& piece) {
    piece.viscosity = liquid_property_at(scene, "fluid.viscosity", water_viscosity, piece.temperature);
    piece.surface_tension =
        liquid_property_at(scene, "fluid.surface_tension", water_surface_tension, piece.temperature);
    piece.thermal_energy = diffuses ? boltzmann_constant * piece.temperature : 0;
  });
  p.lifetime = p.gas->curve->lifetime();
  const LiquidPiece& middle = piece_at(p.liquid, 0.5 * p.lifetime);
  p.viscosity = middle.viscosity;
  p.surface_tension = middle.surface_tension;
  p.thermal_energy = middle.thermal_energy;
}

double lifetime(const Scene& scene, const ProcessInputs& given) {
  const std::string key = only_one_of(scene, {speeds, speeds + 4}, "the speed of drying", ", or [gas]");
  const double R0 = scene.real("droplet.radius"), value = scene.real(key);
  if (key == "droplet.lifetime") return value;
  if (key == "droplet.evaporation_constant") return R0 * R0 / value;
  if (key == "droplet.front_speed") return R0 / (2 * value);
  if (given.thermal_energy == 0)
    throw scene.error(key, fmt::format("needs diffusion, but particle.brownian_motion = false ({}) makes D = 0 and Pe "
                                       "infinite; set it to true, or give droplet.lifetime, "
                                       "droplet.evaporation_constant or droplet.front_speed instead",
                                       scene.where("particle.brownian_motion")));
  const double D = given.thermal_energy / drag_coefficient(given.viscosity, scene.real("particle.radius"));
  return R0 * R0 / (D * value);
}

}  // namespace

double volume_fraction(double weight_fraction, double particle_density, double liquid_density) {
  const double solids = weight_fraction / particle_density, liquid = (1 - weight_fraction) / liquid_density;
  return solids / (solids + liquid);
}

bool says_number(const Scene& scene) {
  return std::any_of(numbers, numbers + 3, [&](const char* key) { return scene.is_set(key); });
}

double particle_number(const Scene& scene) {
  const std::string key = number_key(scene);
  if (key == "particle.number") return static_cast<double>(scene.integer(key));
  return std::round(solids_given(scene, key) *
                    std::pow(scene.real("droplet.radius") / scene.real("particle.radius"), 3));
}

double memory_of(double particles) { return 3e7 + 1200 * particles; }

ProcessInputs process_inputs(const Scene& scene, const Machine& machine) {
  std::vector<double> radius = particle_radii(scene, machine);
  ProcessInputs p = inputs_without_particles(scene);
  p.radius = std::move(radius);
  return p;
}

ProcessInputs inputs_without_particles(const Scene& scene) {
  ProcessInputs p;
  p.contact_angle = scene.real("fluid.contact_angle") * std::numbers::pi / 180;
  if (has_gas(scene)) {
    add_gas(scene, p);
    return p;
  }
  refuse_without_gas(scene);
  p.viscosity = liquid_property(scene, "fluid.viscosity", water_viscosity, water_viscosity_from, water_viscosity_to);
  p.surface_tension = liquid_property(scene, "fluid.surface_tension", water_surface_tension, water_surface_tension_from,
                                      water_surface_tension_to);
  if (scene.flag("particle.brownian_motion")) p.thermal_energy = boltzmann_constant * scene.real("fluid.temperature");
  p.lifetime = lifetime(scene, p);
  return p;
}

}  // namespace crumble::dryer
