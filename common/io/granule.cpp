#include "common/io/granule.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/contact/material.hpp"
#include "common/io/surface_forces_parameters.hpp"

namespace crumble {

std::string source_of(const Scene& scene, const std::string& key) {
  switch (scene.origin(key)) {
    case Scene::Origin::given:
      return "scene";
    case Scene::Origin::inherited:
      // A section of the same scene, "[gas]", or the file of the stage before.
      return scene.where(key).starts_with('[') ? scene.where(key) : "file";
    default:
      return "default";
  }
}

namespace {

// The number with its unit, or the word that stands for it.
std::string shown(const Scene& scene, const std::string& key, const char* unit) {
  return scene.word(key) ? *scene.word(key) : fmt::format("{:g}{}", scene.real(key), unit);
}

std::optional<double> in_file(const std::optional<Parent>& parent, const std::string& key) {
  if (!parent) return std::nullopt;
  const auto found = parent->properties.find(key);
  return found == parent->properties.end() ? std::nullopt : std::optional(found->second);
}

bool differs(const Scene& scene, const std::string& key, const std::optional<double>& other) {
  return other && (scene.word(key) || scene.real(key) != *other);
}

std::string with_source(const Scene& scene, const std::optional<Parent>& parent, const std::string& key,
                        const char* name, const char* unit) {
  const auto other = in_file(parent, key);
  return fmt::format("{} {} ({}{})", name, shown(scene, key, unit), source_of(scene, key),
                     differs(scene, key, other) ? fmt::format("; the file says {:g}", *other) : "");
}

std::string radius_text(const Scene& scene, const std::optional<Parent>& parent) {
  const bool set = scene.is_set("particle.radius");
  if (!parent) return fmt::format("radius {:g} nm (scene)", 1e9 * scene.real("particle.radius"));
  const double scale = set ? scene.real("particle.radius") / parent->radius : 1;
  if (!set) return fmt::format("radius {:g} nm (file), scaled by 1", 1e9 * parent->radius);
  if (std::abs(scale - 1) < 1e-9)  // the file's nm do not read back to the same bits
    return fmt::format("radius {:g} nm (scene), scaled by 1", 1e9 * parent->radius);
  return fmt::format("radius {:g} nm (scene; the file says {:g}), scaled by {:g}", 1e9 * scene.real("particle.radius"),
                     1e9 * parent->radius, scale);
}

}  // namespace

void inherit(Scene& scene, const Parent& parent) {
  for (const auto& [key, value] : parent.properties)
    if (scene.declares(key)) scene.inherit(key, value, parent.file);
}

Properties properties_of(const Scene& scene, const Properties& parent) {
  Properties properties = parent;
  for (const TravellingKey& k : travelling_keys())
    if (const std::string key(k.key); scene.declares(key) && !scene.word(key)) properties[key] = scene.real(key);
  if (scene.declares("surface_forces.hamaker")) {
    Material material;
    material.surface_energy = properties.at("material.surface_energy");
    take_surface_energy(scene, material);
    properties["material.surface_energy"] = material.surface_energy;
  }
  return properties;
}

void write_properties(AgglomerateWriter& writer, const Properties& properties) {
  for (const TravellingKey& k : travelling_keys())
    if (const auto found = properties.find(std::string(k.key)); found != properties.end())
      writer.put(std::string(k.path), found->second);
}

std::string granule_line(const Scene& scene, const std::optional<Parent>& parent) {
  const auto part = [&](const char* key, const char* name, const char* unit) {
    return ", " + with_source(scene, parent, key, name, unit);
  };
  std::string line = radius_text(scene, parent) + part("material.youngs_modulus", "E", " Pa") +
                     part("material.poisson_ratio", "nu", "") + part("material.surface_energy", "gamma_s", " J/m2") +
                     part("fluid.viscosity", "liquid", " Pa s");
  // Factors of the bond are worth a word only where they are not the paper's.
  for (const TravellingKey& k : travelling_keys())
    if (const std::string key(k.key); key.starts_with("contact.") && scene.declares(key))
      if (scene.real(key) != 1 || differs(scene, key, in_file(parent, key)))
        line += ", " + with_source(scene, parent, key, key.c_str(), "");
  return line;
}

std::string material_warning(const Scene& scene) {
  const Material table_1;
  const std::string energy = "material.surface_energy", modulus = "material.youngs_modulus";
  if (scene.origin(energy) != Scene::Origin::by_default || scene.real(modulus) == table_1.youngs_modulus) return "";
  return fmt::format(
      "warning: E = {:g} Pa ({}) is of another material than the surface energy, {:g} J/m2, which is the default (E = "
      "{:g} "
      "Pa); every strength is proportional to it. Set material.surface_energy; common/contact/SURFACE_ENERGY.md has "
      "values",
      scene.real(modulus), source_of(scene, modulus), scene.real(energy), table_1.youngs_modulus);
}

void report_inputs(Report& report, const Scene& scene, const std::optional<Parent>& parent) {
  for (const std::string& key : scene.keys()) report.input(key, scene.value(key));
  if (const std::string warning = material_warning(scene); !warning.empty()) report.result("material_warning", warning);
  const auto about = [&](const std::string& key, const std::string& from, std::optional<double> other) {
    report.granule(key, scene.value(key), from, other);
  };
  about("particle.radius", scene.is_set("particle.radius") ? "scene" : "file",
        parent ? std::optional(parent->radius) : std::nullopt);
  for (const TravellingKey& k : travelling_keys())
    if (const std::string key(k.key); scene.declares(key)) about(key, source_of(scene, key), in_file(parent, key));
}

}  // namespace crumble
