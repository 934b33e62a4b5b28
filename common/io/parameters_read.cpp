// Reading a scene: TOML by toml++, checked against the table, every complaint with its file and line.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "common/io/parameters.hpp"

namespace crumble {
namespace {

constexpr std::size_t largest_scene = 1 << 20;  // bytes; a data file given by mistake is not parsed

// Letter edits between two words, a swap of neighbours counted as one (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1];
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last), last.swap(now);
  }
  return last[b.size()];
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string_view last_name(std::string_view key) {
  const auto dot = key.rfind('.');
  return dot == std::string_view::npos ? key : key.substr(dot + 1);
}

// What the user wrote, made fit for one line of a message.
std::string shown(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 60)) out += std::iscntrl(static_cast<unsigned char>(c)) ? '?' : c;
  return text.size() > 60 ? out + "..." : out;
}

std::optional<std::vector<double>> numbers_in(const toml::array& array) {
  std::vector<double> numbers;
  for (const auto& element : array) {
    const auto number = element.value<double>();
    if (!element.is_number() || !number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::string shown(const toml::node& node) {
  if (const auto* v = node.as_floating_point()) return toml_text(v->get());
  if (const auto* v = node.as_integer()) return toml_text(v->get());
  if (const auto* v = node.as_boolean()) return toml_text(v->get());
  if (const auto* v = node.as_string()) return '"' + shown(v->get()) + '"';
  if (const auto* array = node.as_array()) {
    if (const auto numbers = numbers_in(*array)) return shown(toml_text(*numbers));
    return "an array";
  }
  if (node.is_table()) return "a table";
  return "a date or time";
}

std::string line_of(const std::string& text, std::size_t number) {
  std::istringstream lines(text);
  std::string line;
  while (number-- > 0 && std::getline(lines, line)) {
  }
  const auto start = line.find_first_not_of(" \t");
  return start == std::string::npos ? "" : line.substr(start);
}

// toml++ begins with "Error while parsing <what>: "; what is wrong follows.
std::string_view without_preamble(std::string_view description) {
  const auto colon = description.find(": ");
  return description.starts_with("Error while parsing") && colon != std::string_view::npos
             ? description.substr(colon + 2)
             : description;
}

std::string did_you_mean(const std::optional<std::string>& guess) {
  return guess ? fmt::format("; did you mean '{}'?", *guess) : "";
}

}  // namespace

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::optional<std::string> best;
  const std::string wanted = lower_case(word);
  std::size_t best_score = std::max<std::size_t>(2, last_name(word).size() / 3) + 1;
  if (word.size() > 200) return {};
  for (const auto& candidate : candidates) {
    // The right name in the wrong section counts as one edit.
    const std::string known = lower_case(candidate);
    const bool dotted = known.find('.') != std::string::npos;
    std::size_t score = edit_distance(wanted, known);
    if (dotted) score = std::min(score, 1 + edit_distance(last_name(wanted), last_name(known)));
    if (score < best_score) best = candidate, best_score = score;
  }
  return best;
}

Override parse_override(const std::string& argument) {
  const auto equals = argument.find('=');
  const auto trimmed = [](std::string text) {
    const auto start = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
    return start == std::string::npos ? std::string() : text.substr(start, end - start + 1);
  };
  Override out{trimmed(argument.substr(0, equals)), "", "--set"};
  if (equals != std::string::npos) out.value = trimmed(argument.substr(equals + 1));
  if (out.key.empty() || out.value.empty())
    throw InputError(fmt::format("--set: '{}' must have the form section.key=value", shown(argument)));
  return out;
}

class SceneReader {
 public:
  SceneReader(const std::string& text, const std::string& file, const ParameterTable& table, bool stored = false)
      : stored_(stored) {
    scene_.file_ = file, scene_.given_ = text, scene_.table_ = table;
    for (const auto& section : table) {
      section_names_.push_back(section.name);
      for (const auto& key : section.former) former_[key] = fmt::format("[[{}]]", section.name);
      for (const auto& p : section.parameters) {
        for (const auto& key : p.former) former_[key] = section.name + "." + p.name;
        for (const auto& key : p.wrong_names) wrong_names_[key] = section.name + "." + p.name;
        for (const auto& s : p.synonyms) {
          synonyms_[section.name + "." + s.name] = {section.name + "." + p.name, s.factor};
          keys_.push_back(section.name + "." + s.name);
        }
        if (!section.repeated) declare(section.name + "." + p.name, p);
      }
    }
  }

  void read_file() {
    const std::string& text = scene_.given_;
    if (text.find('\0') != std::string::npos)
      throw InputError(scene_.file_ + ": this is a binary file; a scene is a TOML text file");
    if (text.size() > largest_scene) throw InputError(scene_.file_ + ": larger than 1 MiB; this is not a scene");
    try {
      read_table(toml::parse(text, scene_.file_), "");
    } catch (const toml::parse_error& error) {
      const auto at = error.source().begin;
      const std::string line = shown(line_of(text, at.line));
      throw InputError(fmt::format("{}:{}: cannot read '{}' (column {}): {}", scene_.file_, at.line, line, at.column,
                                   without_preamble(error.description())));
    }
  }

  void apply(const Override& change) {
    if (const Section* section = repeated(change.key)) return apply_repeated(change, *section);
    if (former_.contains(change.key)) return renamed(change.origin, change.key);
    if (wrong_names_.contains(change.key)) return called_otherwise(change.origin, change.key);
    if (synonyms_.contains(change.key)) {
      Scene::Entry& entry = scene_.entries_.at(synonyms_.at(change.key).key);
      entry.where.clear();  // takes the place of what the scene says
      try {
        const toml::table parsed = toml::parse("value = " + change.value);
        if (parsed.size() == 1) return read_synonym(*parsed.get("value"), change.key, change.origin);
      } catch (const toml::parse_error&) {
      }
      entry.where = change.origin;  // wrong, but not missing
      wrong_.push_back(fmt::format("{}: {} = {}: must be a number", change.origin, change.key, shown(change.value)));
      return;
    }
    if (!scene_.entries_.contains(change.key)) return unknown_key(change.origin, change.key);
    Scene::Entry& entry = scene_.entries_.at(change.key);
    const auto& words = entry.parameter.choices;
    const bool is_word = entry.parameter.kind == Parameter::Kind::choice ||
                         entry.parameter.kind == Parameter::Kind::text ||
                         std::find(words.begin(), words.end(), change.value) != words.end();
    // A word needs no quotes here, where the shell has taken them.
    if (is_word && change.value.front() != '"' && change.value.front() != '\'')
      return store(entry, change.key, change.value, toml_text(change.value), change.origin);
    try {
      const toml::table parsed = toml::parse("value = " + change.value);
      if (parsed.size() == 1) return read_value(*parsed.get("value"), change.key, change.origin);
    } catch (const toml::parse_error&) {
    }
    complain(change.origin, change.key, shown(change.value), "must be " + entry.parameter.what_it_takes());
  }

  Scene finish() {
    for (auto& [key, entry] : scene_.entries_) {
      if (!entry.where.empty()) continue;
      entry.where = "default";
      entry.origin = Scene::Origin::by_default;
      entry.value = entry.parameter.fallback;
      if (!entry.value && !entry.parameter.is_optional)
        wrong_.push_back(fmt::format("{}: '{}' is missing; it must be {} ({})", scene_.file_, key,
                                     entry.parameter.what_it_takes(), entry.parameter.meaning));
    }
    if (wrong_.empty()) return std::move(scene_);
    std::string all;
    for (const auto& line : wrong_) all += (all.empty() ? "" : "\n") + line;
    throw InputError(all);
  }

 private:
  // A declaration that contradicts itself is our error, found by whoever first runs the program.
  void declare(const std::string& key, const Parameter& p) {
    const bool fresh = scene_.entries_.emplace(key, Scene::Entry{p, {}, ""}).second;
    if (!fresh) throw std::logic_error("parameter '" + key + "' is declared twice");
    if (p.fallback && (p.fallback->index() != index_of(p.kind) || p.complaint(*p.fallback)))
      throw std::logic_error("the default of '" + key + "' is not allowed by its own declaration");
    keys_.push_back(key);
  }

  static std::size_t index_of(Parameter::Kind kind) {
    switch (kind) {
      case Parameter::Kind::real:
        return 0;
      case Parameter::Kind::integer:
        return 1;
      case Parameter::Kind::flag:
        return 2;
      case Parameter::Kind::list:
        return 4;
      default:
        return 3;
    }
  }

  void read_table(const toml::table& table, const std::string& prefix) {
    for (const auto& [toml_key, node] : table) {
      const std::string key = prefix + std::string(toml_key.str());
      const std::string where = fmt::format("{}:{}", scene_.file_, toml_key.source().begin.line);
      if (const Section* section = repeated(key))
        read_repeated(node, *section, where);
      else if (scene_.entries_.contains(key))
        read_value(node, key, where);
      else if (synonyms_.contains(key))
        read_synonym(node, key, where);
      else if (wrong_names_.contains(key))
        called_otherwise(where, key);
      else if (former_.contains(key))
        stored_ ? read_former(node, former_.at(key), where) : renamed(where, key);
      else if (node.is_table() && leads_to_former_key(key))
        read_table(*node.as_table(), key + ".");
      else if (!leads_to_section(key))
        node.is_table() ? unknown_section(where, key) : unknown_key(where, key);
      else if (node.is_table())
        read_table(*node.as_table(), key + ".");
      else
        wrong_.push_back(
            fmt::format("{}: '{}' is a section, not a key: write [{}] and its keys below", where, key, key));
    }
  }

  bool leads_to_section(const std::string& key) const {
    return std::any_of(section_names_.begin(), section_names_.end(),
                       [&](const std::string& name) { return name == key || name.starts_with(key + "."); });
  }

  bool leads_to_former_key(const std::string& key) const {
    return !leads_to_section(key) &&
           std::any_of(former_.begin(), former_.end(), [&](const auto& f) { return f.first.starts_with(key + "."); });
  }

  void renamed(const std::string& where, const std::string& key) {
    wrong_.push_back(fmt::format("{}: '{}' is now called '{}'", where, key, former_.at(key)));
  }

  void called_otherwise(const std::string& where, const std::string& key) {
    wrong_.push_back(fmt::format("{}: unknown key '{}'; it is called '{}' here", where, key, wrong_names_.at(key)));
  }

  // Synonyms come before or after the key itself, as the letters have it.
  void read_synonym(const toml::node& node, const std::string& key, const std::string& where) {
    const auto& [meant, factor] = synonyms_.at(key);
    Scene::Entry& entry = scene_.entries_.at(meant);
    if (given_twice(entry, where, key, given_as_.contains(meant) ? given_as_.at(meant) : meant)) return;
    given_as_[meant] = key;
    const auto number = node.is_number() ? node.value<double>() : std::nullopt;
    if (!number) {
      entry.where = where;  // wrong, but not missing
      wrong_.push_back(fmt::format("{}: {} = {}: must be a number", where, key, shown(node)));
      return;
    }
    store(entry, meant, factor * *number, fmt::format("{:g} (from {} = {})", factor * *number, key, shown(node)),
          where);
  }

  // The same thing by two keys; one of the two must go.
  bool given_twice(const Scene::Entry& entry, const std::string& where, const std::string& key,
                   const std::string& other) {
    if (entry.where.empty() || !where.starts_with(scene_.file_ + ":")) return false;
    wrong_.push_back(
        fmt::format("{}: {} says again what {} says ({}); remove one of the two", where, key, other, entry.where));
    return true;
  }

  // A value of an earlier version that has another form now is left out: the default stands.
  void read_former(const toml::node& node, const std::string& key, const std::string& where) {
    if (!scene_.entries_.contains(key)) return;
    const std::size_t complaints = wrong_.size();
    read_value(node, key, where);
    if (wrong_.size() == complaints) return;
    wrong_.resize(complaints);
    scene_.entries_.at(key).where.clear();
  }

  const Section* repeated(const std::string& key) const {
    for (const Section& section : scene_.table_)
      if (section.repeated && section.name == key) return &section;
    return nullptr;
  }

  void read_repeated(const toml::node& node, const Section& section, const std::string& where) {
    const auto* array = node.as_array();
    if (!array || !std::all_of(array->begin(), array->end(), [](const toml::node& n) { return n.is_table(); })) {
      wrong_.push_back(fmt::format("{}: '{}' must be tables: write [[{}]] and its keys below, once for each", where,
                                   section.name, section.name));
      return;
    }
    for (std::size_t k = 0; k < array->size(); ++k) {
      const std::string prefix = fmt::format("{}[{}].", section.name, k);
      for (const auto& p : section.parameters) declare(prefix + p.name, p);
      scene_.counts_[section.name] = k + 1;
      read_table(*array->get(k)->as_table(), prefix);
    }
  }

  // Takes the place of all that the scene says.
  void apply_repeated(const Override& change, const Section& section) {
    std::erase_if(scene_.entries_, [&](const auto& entry) { return entry.first.starts_with(section.name + "["); });
    scene_.counts_.erase(section.name);
    try {
      const toml::table parsed = toml::parse("value = " + change.value);
      if (parsed.size() == 1) return read_repeated(*parsed.get("value"), section, change.origin);
    } catch (const toml::parse_error&) {
    }
    wrong_.push_back(fmt::format("{}: {} = {}: must be tables, written [{{kind = \"ramp\", rate = 5000}}]",
                                 change.origin, section.name, shown(change.value)));
  }

  void unknown_key(const std::string& where, const std::string& key) {
    wrong_.push_back(fmt::format("{}: unknown key '{}'{}", where, shown(key), did_you_mean(nearest(key, keys_))));
  }

  void unknown_section(const std::string& where, const std::string& key) {
    std::string hint = did_you_mean(nearest(key, section_names_));
    if (hint.empty()) {
      for (const auto& name : section_names_) hint += (hint.empty() ? "; the sections are " : ", ") + name;
    }
    wrong_.push_back(fmt::format("{}: unknown section '{}'{}", where, shown(key), hint));
  }

  void complain(const std::string& where, const std::string& key, const std::string& found, const std::string& what) {
    wrong_.push_back(fmt::format("{}: {} = {}: {}", where, key, found, what));
    scene_.entries_.at(key).where = where;  // wrong, but not missing
  }

  void read_value(const toml::node& node, const std::string& key, const std::string& where) {
    Scene::Entry& entry = scene_.entries_.at(key);
    if (const auto other = given_as_.find(key);
        other != given_as_.end() && given_twice(entry, where, key, other->second))
      return;
    const auto kind = entry.parameter.kind;
    std::optional<ParameterValue> value;
    if (kind == Parameter::Kind::real && node.is_floating_point()) value = node.as_floating_point()->get();
    if (kind == Parameter::Kind::real && node.is_integer()) value = static_cast<double>(node.as_integer()->get());
    if (kind == Parameter::Kind::integer && node.is_integer()) value = node.as_integer()->get();
    if (kind == Parameter::Kind::flag && node.is_boolean()) value = node.as_boolean()->get();
    if (kind == Parameter::Kind::list && node.is_array())
      if (auto numbers = numbers_in(*node.as_array())) value = std::move(*numbers);
    if ((kind == Parameter::Kind::choice || kind == Parameter::Kind::text || !entry.parameter.choices.empty()) &&
        node.is_string())
      value = node.as_string()->get();
    if (!value) return complain(where, key, shown(node), "must be " + entry.parameter.what_it_takes());
    store(entry, key, *value, shown(node), where);
  }

  void store(Scene::Entry& entry, const std::string& key, const ParameterValue& value, const std::string& found,
             const std::string& where) {
    if (const auto complaint = entry.parameter.complaint(value)) return complain(where, key, found, *complaint);
    entry.value = value;
    entry.where = where;
    entry.origin = Scene::Origin::given;
  }

  Scene scene_;
  bool stored_ = false;  // a resolved scene out of a file
  std::vector<std::string> keys_, section_names_, wrong_;
  struct Meant {
    std::string key;
    double factor;
  };
  std::map<std::string, std::string> given_as_;     // by which synonym
  std::map<std::string, Meant> synonyms_;           // full names
  std::map<std::string, std::string> wrong_names_;  // what others call it -> what it is called here
  std::map<std::string, std::string> former_;       // former names -> what they are called now
};

Scene Scene::parse(const std::string& text, const std::string& file, const ParameterTable& table,
                   const std::vector<Override>& overrides) {
  SceneReader reader(text, file, table);
  reader.read_file();
  for (const auto& change : overrides) reader.apply(change);
  return reader.finish();
}

Scene Scene::parse_stored(const std::string& text, const std::string& file, const ParameterTable& table) {
  SceneReader reader(text, file, table, true);
  reader.read_file();
  return reader.finish();
}

Scene Scene::read(const std::string& file, const ParameterTable& table, const std::vector<Override>& overrides) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string text(largest_scene + 1, ' ');
  if (in) in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in.is_open() || in.bad())
    throw InputError(fmt::format("{}: cannot read the scene: {}", file, std::strerror(errno)));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parse(text, file, table, overrides);
}

}  // namespace crumble
