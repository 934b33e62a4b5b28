#include "common/io/form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace crumble::schema {

namespace {

using hdf5::Kind;
using hdf5::Type;

std::string_view kind_name(Kind kind) {
  switch (kind) {
    case Kind::missing:
      return "nothing";
    case Kind::group:
      return "a group";
    case Kind::dataset:
      return "a dataset";
    case Kind::other:
      break;
  }
  return "another object";
}

bool is_global(const std::string& symbol) { return symbol == "T" || symbol == "N" || symbol == "M" || symbol == "L"; }

std::string quoted(const std::vector<std::string>& texts) {
  std::string list;
  for (const auto& text : texts) list += (list.empty() ? "'" : ", '") + text + "'";
  return list.empty() ? "nothing" : list;
}

void check_unit(const hdf5::Dataset& dataset, const std::string& path, std::string_view unit,
                std::vector<Violation>& violations) {
  const bool has = dataset.has_attribute("unit");
  if (has && dataset.attribute_type("unit") != Type::text) {
    violations.push_back({path + "@unit", "text", std::string(hdf5::type_name(dataset.attribute_type("unit")))});
    return;
  }
  const auto found = has ? dataset.text_attribute("unit") : std::vector<std::string>{};
  if (unit == "any" || (unit.empty() && !has)) return;
  if (unit.empty())
    violations.push_back({path + "@unit", "no unit (dimensionless)", quoted(found)});
  else if (found.size() != 1 || found[0] != unit)
    violations.push_back({path + "@unit", fmt::format("'{}'", unit), quoted(found)});
}

void check_dataset(const hdf5::Group& root, const std::string& path, Type type, std::string_view shape,
                   std::string_view unit, Sizes& sizes, std::vector<Violation>& violations) {
  const Kind kind = root.kind(path);
  if (kind != Kind::dataset) {
    violations.push_back({path, "a dataset", std::string(kind_name(kind))});
    return;
  }
  const hdf5::Dataset dataset = root.dataset(path);
  if (dataset.type() != type)
    violations.push_back({path, std::string(hdf5::type_name(type)), std::string(hdf5::type_name(dataset.type()))});
  if (const auto expected = sizes.mismatch(path, shape, dataset.shape()); !expected.empty())
    violations.push_back({path, "shape " + expected, hdf5::shape_text(dataset.shape())});
  else if (type != Type::text && !dataset.is_stored())
    violations.push_back({path, hdf5::shape_text(dataset.shape()) + " as declared", "less data in the file"});
  check_unit(dataset, path, unit, violations);
}

void check_attribute(const hdf5::Group& root, const Entry& entry, const std::string& path,
                     std::vector<Violation>& violations) {
  const auto at = path.find('@');
  const std::string owner = path.substr(0, at), name = path.substr(at + 1);
  if (root.kind(owner) != Kind::group) {
    violations.push_back({owner, "a group", std::string(kind_name(root.kind(owner)))});
    return;
  }
  const hdf5::Group group = root.group(owner);
  if (!group.has_attribute(name)) {
    violations.push_back({path, "an attribute", "nothing"});
    return;
  }
  if (group.attribute_type(name) != entry.type) {
    violations.push_back(
        {path, std::string(hdf5::type_name(entry.type)), std::string(hdf5::type_name(group.attribute_type(name)))});
    return;
  }
  Sizes none;
  const auto shape = group.attribute_shape(name);
  if (const auto expected = none.mismatch(path, entry.shape, shape); !expected.empty())
    violations.push_back({path, "shape " + expected, hdf5::shape_text(shape)});
  else if (!entry.values.empty())
    for (const auto& text : group.text_attribute(name)) {
      const std::string one = "|" + text + "|", all = "|" + std::string(entry.values) + "|";
      if (all.find(one) == all.npos || text.empty()) {
        std::string choices(entry.values);
        std::replace(choices.begin(), choices.end(), '|', ' ');
        violations.push_back({path, "one of: " + choices, "'" + text + "'"});
        break;
      }
    }
}

}  // namespace

std::string Sizes::mismatch(const std::string& path, std::string_view expected, const hdf5::Shape& found) {
  const auto symbols = words(expected);
  std::string text = symbols.empty() ? "scalar" : "";
  bool fits = symbols.size() == found.size();
  std::map<std::string, std::uint64_t> bound;
  const std::string scope = path.substr(0, path.rfind('/')) + "#";
  for (std::size_t d = 0; d < symbols.size(); ++d) {
    std::string symbol(symbols[d]);
    std::uint64_t size = 0;
    if (std::from_chars(symbol.data(), symbol.data() + symbol.size(), size).ec == std::errc()) {
      text += fmt::format("[{}]", size);
      fits = fits && found[d] == size;
      continue;
    }
    const bool one_more = symbol.ends_with("+1");
    const std::string name = symbol.substr(0, symbol.find('+')), key = is_global(name) ? name : scope + name;
    if (const auto known = known_.find(key); known != known_.end()) {
      text += fmt::format("[{}={}]", symbol, known->second + one_more);
      fits = fits && found[d] == known->second + one_more;
    } else {
      text += "[" + symbol + "]";
      if (fits && one_more && found[d] == 0) fits = false;
      if (fits) bound[key] = found[d] - one_more;
    }
  }
  if (!fits) return text;
  known_.merge(bound);
  return "";
}

std::uint64_t Sizes::of(const std::string& symbol) const {
  const auto known = known_.find(symbol);
  return known == known_.end() ? 0 : known->second;
}

std::vector<Violation> check_form(const hdf5::Group& root, const Entry& entry, const std::string& path, Sizes& sizes) {
  std::vector<Violation> violations;
  switch (entry.layout) {
    case Layout::group:
      if (root.kind(path) != Kind::group)
        violations.push_back({path, "a group", std::string(kind_name(root.kind(path)))});
      break;
    case Layout::attribute:
      check_attribute(root, entry, path, violations);
      break;
    case Layout::dataset:
      check_dataset(root, path, entry.type, entry.shape, entry.unit, sizes, violations);
      break;
    case Layout::frames:
    case Layout::samples: {
      if (root.kind(path) != Kind::group) {
        violations.push_back({path, "a group of step, time and value", std::string(kind_name(root.kind(path)))});
        break;
      }
      const std::string_view rows = words(entry.shape).front();
      check_dataset(root, path + "/value", entry.type, entry.shape, entry.unit, sizes, violations);
      check_dataset(root, path + "/step", Type::int64, rows, "", sizes, violations);
      check_dataset(root, path + "/time", Type::float64, rows, "s", sizes, violations);
      break;
    }
    case Layout::link:
      if (root.soft_link_target(path) != "all" || root.kind(path) != Kind::group)
        violations.push_back(
            {path, "a soft link to 'all'", root.kind(path) == Kind::missing ? "nothing" : "something else"});
      break;
  }
  return violations;
}

}  // namespace crumble::schema
