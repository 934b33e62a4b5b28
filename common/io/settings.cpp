#include "common/io/settings.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>

#include "common/io/parameters.hpp"

namespace crumble {

namespace {

void collect(const toml::node& node, const std::string& key, Settings& into) {
  if (const auto* table = node.as_table()) {
    for (const auto& [name, below] : *table)
      collect(below, (key.empty() ? "" : key + ".") + std::string(name.str()), into);
    return;
  }
  if (const auto* array = node.as_array(); array && array->is_array_of_tables()) {
    for (std::size_t k = 0; k < array->size(); ++k) collect(*array->get(k), fmt::format("{}[{}]", key, k), into);
    return;
  }
  if (const auto number = node.value_exact<double>()) {
    into[key] = fmt::format("{}", *number);
    return;
  }
  std::ostringstream text;
  text << toml::node_view<const toml::node>(node);
  into[key] = text.str();
}

std::string value_in(const Settings& settings, const std::string& key) {
  const auto found = settings.find(key);
  return found == settings.end() ? "not set" : found->second;
}

}  // namespace

Settings settings_in(const std::string& resolved) {
  Settings settings;
  try {
    collect(toml::parse(resolved), "", settings);
  } catch (const toml::parse_error&) {
    settings.clear();
  }
  return settings;
}

std::vector<SettingDifference> differences(const Settings& first, const Settings& second) {
  Settings all = first;
  all.insert(second.begin(), second.end());
  std::vector<SettingDifference> found;
  for (const auto& [key, ignored] : all)
    if (const std::string a = value_in(first, key), b = value_in(second, key); a != b) found.push_back({key, a, b});
  return found;
}

}  // namespace crumble
