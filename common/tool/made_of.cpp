#include "common/tool/made_of.hpp"

#include <fmt/format.h>

namespace crumble::tool {

MadeOf made_of(const Properties& typed, const Properties& parent) {
  MadeOf m;
  m.properties = parent;
  const auto take = [&](const std::string& key, const char* name, const char* unit, double& value) {
    const auto option = typed.find(key), before = parent.find(key);
    const char* source = option != typed.end() ? "option" : before != parent.end() ? "file" : "default";
    if (option != typed.end())
      value = option->second;
    else if (before != parent.end())
      value = before->second;
    const bool differs = option != typed.end() && before != parent.end() && before->second != value;
    m.text += fmt::format("{}{} {:g}{} ({}{})", m.text.empty() ? "" : ", ", name, value, unit, source,
                          differs ? fmt::format("; the file says {:g}", before->second) : "");
    m.properties[key] = value;
  };
  take("material.youngs_modulus", "E", " Pa", m.material.youngs_modulus);
  take("material.poisson_ratio", "nu", "", m.material.poisson_ratio);
  take("material.surface_energy", "gamma_s", " J/m2", m.material.surface_energy);
  take("material.density", "density", " kg/m3", m.material.density);
  const auto is_given = [&](const char* key) { return typed.contains(key) || parent.contains(key); };
  if (is_given("material.youngs_modulus") && !is_given("material.surface_energy") &&
      m.material.youngs_modulus != Material().youngs_modulus)
    m.text +=
        "\nwarning: the surface energy is the default, E is of another material; every strength is proportional to it";
  return m;
}

}  // namespace crumble::tool
