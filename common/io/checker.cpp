#include "common/io/checker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <new>
#include <set>

#include "common/io/check_values.hpp"
#include "common/io/file_errors.hpp"
#include "common/io/in_child.hpp"

namespace crumble {

namespace {

using hdf5::Kind;
using schema::Entry;
using schema::Layout;

const std::string module_path = "/h5md/modules/agglomerate";

class Checker {
 public:
  Checker(const std::filesystem::path& path, bool looks_at_parent)
      : path_(path), file_(hdf5::File::open(path)), looks_at_parent_(looks_at_parent) {}

  std::vector<Violation> run() {
    if (!version_is_ours()) return violations_;
    required_ = stage();
    for (const Entry& entry : schema::table())
      for (const auto& path : instances(entry)) guarded(path, [&] { form(entry, path); });
    for (const auto& path : unknown_observables()) guarded(path, [&] { flat_observable(path); });
    guarded(module_path, [&] { complete(); });
    values();
    return violations_;
  }

 private:
  // What the library cannot read is a violation, not the end of the check.
  void guarded(const std::string& path, const std::function<void()>& rule) {
    try {
      rule();
    } catch (const ContentError& error) {
      violations_.push_back({path, "readable data", error.what()});
    } catch (const std::bad_alloc&) {
      violations_.push_back({path, "data that fits in memory", "more"});
    }
  }

  // Another version has another table, so nothing else is looked at.
  bool version_is_ours() {
    bool ours = false;
    guarded(module_path, [&] {
      const std::string path = module_path + "@version";
      const auto wrong = schema::check_form(file_, *schema::find(path), path, sizes_);
      violations_.insert(violations_.end(), wrong.begin(), wrong.end());
      if (!wrong.empty()) return;
      const auto version = file_.group(module_path).attribute<std::int32_t>("version");
      ours = version[0] == schema::version_major && version[1] >= 0 && version[1] <= schema::version_minor;
      if (!ours)
        violations_.push_back(
            {path, fmt::format("{}.0 to {}.{}", schema::version_major, schema::version_major, schema::version_minor),
             fmt::format("{}.{}", version[0], version[1])});
    });
    return ours;
  }

  unsigned stage() {
    unsigned required = schema::all;
    guarded(module_path, [&] {
      const auto group = file_.group(module_path);
      if (!group.has_attribute("stage")) return;
      const auto names = group.text_attribute("stage");
      if (names.size() != 1) return;
      if (const auto stage = schema::stage_named(names[0])) required = *stage;
    });
    return required;
  }

  // The paths that a row of the table stands for: its own, or one for each name in the group before <name>.
  std::vector<std::string> instances(const Entry& entry) {
    const std::string path(entry.path);
    const auto mark = path.find("<name>");
    if (mark == path.npos) return {path};
    std::vector<std::string> list;
    const std::string parent = path.substr(0, mark - 1);
    guarded(parent, [&] {
      if (file_.kind(parent) != Kind::group) return;
      for (const auto& name : file_.group(parent).names())
        list.push_back(path.substr(0, mark) + name + path.substr(mark + 6));
    });
    return list;
  }

  bool exists(const std::string& path) const {
    const auto at = path.find('@');
    const std::string object = path.substr(0, at);
    if (file_.kind(object) == Kind::missing) return false;
    if (at == path.npos) return true;
    return file_.kind(object) == Kind::group && file_.group(object).has_attribute(path.substr(at + 1));
  }

  void form(const Entry& entry, const std::string& path) {
    // A stage that is not known is a violation already; then only what every stage needs is asked for.
    const bool required = required_ == schema::all ? entry.required == schema::all : (entry.required & required_) != 0;
    if (!required && !exists(path)) return;
    const auto wrong = schema::check_form(file_, entry, path, sizes_);
    violations_.insert(violations_.end(), wrong.begin(), wrong.end());
    if (wrong.empty()) {
      sound_.insert(path);
      entries_.emplace_back(&entry, path);
    }
  }

  // Observables that we do not know must still be what readers of H5MD expect: flat, with a row for each frame.
  std::vector<std::string> unknown_observables() {
    std::vector<std::string> list;
    guarded("/observables", [&] {
      if (file_.kind("/observables") != Kind::group) return;
      for (const auto& name : file_.group("/observables").names())
        if (!schema::find("/observables/" + name)) list.push_back("/observables/" + name);
    });
    return list;
  }

  void flat_observable(const std::string& path) {
    const std::string value = path + "/value";
    if (file_.kind(value) != Kind::dataset) {
      violations_.push_back({path, "a group with a dataset 'value'", "none"});
      return;
    }
    const auto shape = file_.dataset(value).shape();
    if (shape.empty() || shape[0] != sizes_.of("T"))
      violations_.push_back({value, fmt::format("shape [T={}]...", sizes_.of("T")), hdf5::shape_text(shape)});
  }

  void complete() {
    const std::string path = module_path + "@complete";
    if (!sound_.contains(path)) return;
    const int found = file_.group(module_path).attribute<std::uint8_t>("complete").at(0);
    if (found != 1) violations_.push_back({path, "1", std::to_string(found)});
  }

  void exactly(const std::string& path, std::int32_t expected) {
    if (!sound_.contains(path)) return;
    const auto at = path.find('@');
    const auto found = file_.group(path.substr(0, at)).attribute<std::int32_t>(path.substr(at + 1)).at(0);
    if (found != expected) violations_.push_back({path, std::to_string(expected), std::to_string(found)});
  }

  void values() {
    const check::Context context{file_, sizes_, sound_, violations_};
    guarded("/h5md", [&] { exactly("/h5md@version", 1); });
    guarded("/h5md", [&] { exactly("/h5md/modules/units@version", 1); });
    guarded("/particles/all/box", [&] { exactly("/particles/all/box@dimension", 3); });
    if (sound_.contains("/particles/all/position") && sizes_.of("T") == 0)
      violations_.push_back({"/particles/all/position", "a frame", "none"});
    if (sound_.contains("/particles/all/radius") && sizes_.of("N") == 0)
      violations_.push_back({"/particles/all/radius", "a particle", "none"});
    for (const auto& [entry, path] : entries_) {
      const bool timed = entry->layout == Layout::frames || entry->layout == Layout::samples;
      if (!timed && entry->layout != Layout::dataset) continue;
      guarded(path, [&, entry = entry, path = path] { of_array(context, *entry, path, timed); });
    }
    guarded("/particles/all", [&] { check::particles(context); });
    guarded("/contacts", [&] { check::contacts(context); });
    guarded("/", [&] { check::ranges(context); });
    // Numbers that are no numbers, or of no particle, mean nothing.
    if (violations_.empty()) guarded("/contacts", [&] { check::frames(context); });
    if (violations_.empty()) guarded("/", [&] { check::results(context); });
    if (looks_at_parent_) guarded("/parameters/provenance", [&] { check::parent(context, path_); });
  }

  void of_array(const check::Context& context, const Entry& entry, const std::string& path, bool timed) {
    const std::string value = timed ? path + "/value" : path;
    if (entry.type == hdf5::Type::float64) check::finite(context, value);
    if (entry.type == hdf5::Type::text) file_.dataset(path).read_text();
    if (entry.shape.ends_with(" 4")) check::unit_length(context, value, 4);
    if (path == "/contacts/normal") check::unit_length(context, value, 3);
    if (!timed) return;
    if (path == "/particles/all/position" || entry.layout == Layout::samples) {
      check::finite(context, path + "/time");
      check::increasing(context, path);
    } else {
      check::same_instants(context, path);
    }
  }

  std::filesystem::path path_;
  hdf5::File file_;
  bool looks_at_parent_;
  schema::Sizes sizes_;
  unsigned required_ = schema::all;
  std::set<std::string> sound_;
  std::vector<std::pair<const Entry*, std::string>> entries_;
  std::vector<Violation> violations_;
};

// Violations as text and back, for the way out of the child process.
std::string packed(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& violation : violations)
    for (const std::string* part : {&violation.path, &violation.expected, &violation.found}) text += *part + '\0';
  return text;
}

std::vector<Violation> unpacked(std::string_view text) {
  const auto part = [&] {
    const std::string word(text.substr(0, text.find('\0')));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    return word;
  };
  std::vector<Violation> violations;
  while (!text.empty()) {
    Violation violation;
    violation.path = part();
    violation.expected = part();
    violation.found = part();
    violations.push_back(violation);
  }
  return violations;
}

}  // namespace

void require_valid(const std::filesystem::path& path) {
  const auto violations = Checker(path, false).run();
  if (violations.empty()) return;
  const std::string more = violations.size() > 1 ? fmt::format(" (and {} more)", violations.size() - 1) : "";
  throw ContentError(path.string() + ": " + violations.front().text() + more);
}

std::vector<Violation> check_file(const std::filesystem::path& path) {
  try {
    return unpacked(in_child(path, [&] { return packed(Checker(path, true).run()); }));
  } catch (const ContentError& error) {
    return {{"/", "a file that can be read", error.what()}};
  }
}

}  // namespace crumble
