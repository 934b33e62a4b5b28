#include "common/io/properties.hpp"

#include <toml++/toml.h>

#include <array>

namespace crumble {

namespace {

constexpr auto table = std::to_array<TravellingKey>({
    {"material.youngs_modulus", "/material/youngs_modulus"},
    {"material.poisson_ratio", "/material/poisson_ratio"},
    {"material.surface_energy", "/material/surface_energy"},
    {"material.density", "/material/density"},
    {"contact.sliding_limit_factor", "/material/sliding_limit_factor"},
    {"contact.twisting_limit_factor", "/material/twisting_limit_factor"},
    {"contact.rolling_limit_factor", "/material/rolling_limit_factor"},
    {"contact.rolling_stiffness_factor", "/material/rolling_stiffness_factor", "structure.bending_factor"},
    {"fluid.viscosity", "/fluid/viscosity", "liquid.viscosity"},
});

}  // namespace

std::span<const TravellingKey> travelling_keys() { return table; }

Properties properties_in(const std::string& resolved) {
  Properties properties;
  try {
    const toml::table scene = toml::parse(resolved);
    for (const TravellingKey& k : table)
      for (const std::string_view key : {k.former, k.key})
        if (!key.empty())
          if (const auto number = scene.at_path(key).value<double>()) properties[std::string(k.key)] = *number;
  } catch (const toml::parse_error&) {
  }
  return properties;
}

Properties read_properties(const hdf5::File& file) {
  Properties properties;
  for (const TravellingKey& k : table)
    if (const std::string path(k.path); file.kind(path) == hdf5::Kind::dataset)
      properties[std::string(k.key)] = file.dataset(path).read<double>().at(0);
  if (properties.empty() && file.kind("/parameters/resolved") == hdf5::Kind::dataset)
    return properties_in(file.dataset("/parameters/resolved").read_text());
  return properties;
}

}  // namespace crumble
