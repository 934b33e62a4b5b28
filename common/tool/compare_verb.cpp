#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "common/io/agglomerate_reader.hpp"
#include "common/io/settings.hpp"
#include "common/tool/quantities.hpp"
#include "common/tool/verbs.hpp"

namespace crumble::tool {
namespace {

// A number of a file and its stated error, relative.
struct Result {
  double value = 0;
  std::optional<double> error;
};
using Results = std::vector<std::pair<std::string, Result>>;

struct Side {
  explicit Side(const std::string& file) : reader(file), content(hdf5::File::open(file)) {}
  AgglomerateReader reader;  // has checked the file
  hdf5::File content;

  std::optional<double> number(const std::string& path) const {
    if (content.kind(path) != hdf5::Kind::dataset) return std::nullopt;
    return content.dataset(path).read<double>().at(0);
  }
};

Results results_of(const Side& side) {
  Results all;
  const Morphology m = crumble::morphology(side.reader.particles(), side.reader.last_frame());
  for (const Quantity& q : quantities()) {
    const std::string name = q.name;
    const bool counted = name == "coordination";  // follows from the contacts
    const std::string stated = name == "d_c_nm" ? "d_c" : counted ? "contacts" : name;
    all.push_back({name, {q.value(m), side.number("/errors/" + stated)}});
  }
  if (const auto stress = side.number("/breakup/critical_stress"))
    all.push_back({"critical_stress_pa", {*stress, side.number("/errors/critical_stress")}});
  if (side.content.kind("/flows") == hdf5::Kind::group)
    for (const std::string& flow : side.content.group("/flows").names())
      if (const auto stress = side.number("/flows/" + flow + "/critical_stress"))
        all.push_back({flow + ".critical_stress_pa", {*stress, side.number("/response/error")}});
  return all;
}

Settings provenance_of(const FileInfo& info) {
  const Provenance& p = info.provenance;
  return {{"program", p.program},
          {"version", p.version},
          {"commit", p.git + (p.dirty ? " with changes" : "")},
          {"compiler", p.compiler},
          {"flags", p.flags},
          {"BLAS", p.blas},
          {"seed", std::to_string(p.seed)},
          {"parent", p.parent_sha256.empty() ? "none" : p.parent + " (sha256 " + p.parent_sha256.substr(0, 12) + ")"}};
}

Settings made_of(const FileInfo& info) {
  Settings made;
  for (const auto& [key, value] : info.properties) made[key] = fmt::format("{:g}", value);
  return made;
}

// Of two programs only what both have: all else differs of itself.
std::vector<SettingDifference> scene_differences(const AgglomerateReader& a, const AgglomerateReader& b) {
  const Settings first = settings_in(a.resolved()), second = settings_in(b.resolved());
  std::vector<SettingDifference> all = differences(first, second);
  if (a.info().stage != b.info().stage)
    std::erase_if(all, [&](const auto& d) { return !first.contains(d.key) || !second.contains(d.key); });
  return all;
}

void tell(std::ostream& out, const char* what, const std::vector<SettingDifference>& different) {
  out << fmt::format("{}: {}\n", what, different.empty() ? "the same" : "");
  for (const auto& [key, first, second] : different) out << fmt::format("  {:<34}{} | {}\n", key, first, second);
}

const Result* find(const Results& results, const std::string& name) {
  for (const auto& [key, result] : results)
    if (key == name) return &result;
  return nullptr;
}

std::string percent(const std::optional<double>& error) {
  return error ? fmt::format("{:.2g} %", 100 * *error) : "not stated";
}

}  // namespace

int compare(const CompareOptions& options, std::ostream& out) {
  constexpr int equal = 0, different = 1;
  const Side a(options.first), b(options.second);
  out << fmt::format("{} | {}\n", options.first, options.second);
  tell(out, "scene", scene_differences(a.reader, b.reader));
  tell(out, "made of", differences(made_of(a.reader.info()), made_of(b.reader.info())));
  tell(out, "provenance", differences(provenance_of(a.reader.info()), provenance_of(b.reader.info())));

  const Results first = results_of(a), second = results_of(b);
  out << fmt::format("{:<34}{:>12}{:>12}{:>12}{:>13}{:>13}\n", "results:", "first", "second", "change", "error",
                     "error");
  int beyond = 0, unknown = 0;
  for (const auto& [name, one] : first) {
    const Result* other = find(second, name);
    if (!other) continue;
    const double change = other->value - one.value;
    const bool stated = one.error && other->error;
    const double allowed = stated ? *one.error * std::abs(one.value) + *other->error * std::abs(other->value) : 0;
    const bool differs = std::abs(change) > allowed;
    beyond += differs && stated;
    unknown += differs && !stated;
    out << fmt::format("  {:<32}{:>12.6g}{:>12.6g}{:>12}{:>13}{:>13}  {}\n", name, one.value, other->value,
                       change == 0      ? "0"
                       : one.value != 0 ? fmt::format("{:+.2g} %", 100 * change / std::abs(one.value))
                                        : fmt::format("{:+.3g}", change),
                       percent(one.error), percent(other->error),
                       change == 0 ? "equal"
                       : !stated   ? "differs, by an error that is not stated"
                       : differs   ? "differs by more than the errors"
                                   : "within the errors");
  }
  for (const auto& [name, result] : second)
    if (!find(first, name)) out << fmt::format("  {:<32}{:>12}{:>12.6g}\n", name, "-", result.value);
  for (const auto& [name, result] : first)
    if (!find(second, name)) out << fmt::format("  {:<32}{:>12.6g}{:>12}\n", name, result.value, "-");
  out << fmt::format("{} differ by more than the errors, {} more differ without a stated error\n", beyond, unknown);
  return beyond + unknown > 0 ? different : equal;
}

}  // namespace crumble::tool
