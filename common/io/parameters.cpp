#include "common/io/parameters.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace crumble {
namespace {

// The fewest digits that read back to the same double; powers of ten where zeros would have to be counted.
std::string number_text(double value) {
  const double size = std::fabs(value);
  const bool plain = size == 0 || (size >= 1e-3 && size < 1e6);
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, value,
                                 plain ? std::chars_format::fixed : std::chars_format::scientific);
  std::string text(digits, end.ptr);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";  // TOML would take "10" for an integer
  return text;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      out += c;
  }
  return out + '"';
}

std::string joined(const std::vector<std::string>& words, std::string_view last_separator) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 == words.size() ? last_separator : ", ";
    out += words[i];
  }
  return out;
}

double as_number(const ParameterValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  return std::get<double>(value);
}

std::string bounds_text(const Parameter& p) {
  if (p.low && p.high && !p.low->open && !p.high->open) return fmt::format("{} to {}", p.low->value, p.high->value);
  std::string out;
  if (p.low) out = fmt::format("{} {}", p.low->open ? ">" : ">=", p.low->value);
  if (p.low && p.high) out += " and ";
  if (p.high) out += fmt::format("{} {}", p.high->open ? "<" : "<=", p.high->value);
  return out;
}

// ", or "water"": what a real takes beside numbers.
std::string words_of_a_real(const Parameter& p) {
  if (p.kind != Parameter::Kind::real || p.choices.empty()) return "";
  std::vector<std::string> words;
  for (const auto& word : p.choices) words.push_back(quoted(word));
  return ", or " + joined(words, " or ");
}

std::string heading(const Section& section) {
  return section.repeated ? "[[" + section.name + "]]" : "[" + section.name + "]";
}

std::string status_of(const Parameter& p) {
  if (p.fallback) return toml_text(*p.fallback);
  return p.is_optional ? "not set" : "required";
}

std::string with_comment_marks(const std::string& text) {
  std::string out = "# ";
  for (const char c : text) out += c == '\n' ? std::string("\n# ") : std::string(1, c);
  return out + "\n";
}

std::string assignment(const Parameter& p, const std::optional<ParameterValue>& value) {
  const std::string unit = p.unit.empty() ? "" : "  # " + p.unit;
  if (value) return fmt::format("{} = {}{}\n", p.name, toml_text(*value), unit);
  return fmt::format("# {} =   ({}){}\n", p.name, status_of(p), p.unit.empty() ? "" : "  in " + p.unit);
}

}  // namespace

Parameter Parameter::real(std::string name, std::string unit, std::string meaning) {
  Parameter p;
  p.name = std::move(name), p.unit = std::move(unit), p.meaning = std::move(meaning), p.kind = Kind::real;
  return p;
}

Parameter Parameter::integer(std::string name, std::string meaning) {
  Parameter p = real(std::move(name), "", std::move(meaning));
  p.kind = Kind::integer;
  return p;
}

Parameter Parameter::flag(std::string name, std::string meaning) {
  Parameter p = real(std::move(name), "", std::move(meaning));
  p.kind = Kind::flag;
  return p;
}

Parameter Parameter::choice(std::string name, std::vector<std::string> choices, std::string meaning) {
  Parameter p = real(std::move(name), "", std::move(meaning));
  p.kind = Kind::choice, p.choices = std::move(choices);
  return p;
}

Parameter Parameter::text(std::string name, std::string meaning) {
  Parameter p = real(std::move(name), "", std::move(meaning));
  p.kind = Kind::text;
  return p;
}

Parameter Parameter::list(std::string name, std::string unit, std::string meaning) {
  Parameter p = real(std::move(name), std::move(unit), std::move(meaning));
  p.kind = Kind::list;
  return p;
}

Parameter Parameter::or_by(std::string other, double factor) const {
  Parameter p = *this;
  p.synonyms.push_back({std::move(other), factor});
  return p;
}

Parameter Parameter::not_called(std::string key) const {
  Parameter p = *this;
  p.wrong_names.push_back(std::move(key));
  return p;
}

std::string Parameter::explained() const {
  std::string text = meaning;
  for (const Synonym& s : synonyms)
    text += s.factor == 1 ? fmt::format("; or `{}`", s.name)
                          : fmt::format("; or `{}`, {:g} times that", s.name, 1 / s.factor);
  return text;
}

Parameter Parameter::formerly(std::string key) const {
  Parameter p = *this;
  p.former.push_back(std::move(key));
  return p;
}

Parameter Parameter::with_default(ParameterValue value) const {
  Parameter p = *this;
  p.fallback = std::move(value);
  return p;
}

Parameter Parameter::by_default(double value) const { return with_default(value); }
Parameter Parameter::by_default(int value) const {
  return kind == Kind::real ? with_default(static_cast<double>(value)) : with_default(std::int64_t{value});
}
Parameter Parameter::by_default(bool value) const { return with_default(value); }
Parameter Parameter::by_default(const char* value) const { return with_default(std::string(value)); }

Parameter Parameter::optional() const {
  Parameter p = *this;
  p.is_optional = true;
  return p;
}

Parameter Parameter::or_word(std::vector<std::string> words) const {
  Parameter p = *this;
  p.choices = std::move(words);
  return p;
}

Parameter Parameter::above(double bound) const {
  Parameter p = *this;
  p.low = {bound, true};
  return p;
}

Parameter Parameter::at_least(double bound) const {
  Parameter p = *this;
  p.low = {bound, false};
  return p;
}

Parameter Parameter::below(double bound) const {
  Parameter p = *this;
  p.high = {bound, true};
  return p;
}

Parameter Parameter::at_most(double bound) const {
  Parameter p = *this;
  p.high = {bound, false};
  return p;
}

std::string Parameter::range() const {
  if (kind == Kind::choice) return joined(choices, " or ");
  if (kind == Kind::flag) return "true or false";
  return bounds_text(*this) + words_of_a_real(*this);
}

std::string Parameter::what_it_takes() const {
  if (kind == Kind::choice) return "one of " + joined(choices, ", ");
  if (kind == Kind::flag) return "true or false";
  if (kind == Kind::text) return "text in quotes";
  std::string out = kind == Kind::integer ? "a whole number" : kind == Kind::list ? "a list of numbers" : "a number";
  if (low || high) out += " " + bounds_text(*this);
  if (!unit.empty()) out += " in " + unit;
  return out + words_of_a_real(*this) + (kind == Kind::list ? ", written [0.2, 0.4]" : "");
}

std::optional<std::string> Parameter::complaint(const ParameterValue& value) const {
  if (const auto* given = std::get_if<std::string>(&value); given && kind != Kind::text) {
    const auto& word = *given;
    for (const auto& choice : choices)
      if (word == choice) return {};
    const auto guess = nearest(word, choices);
    return "must be " + what_it_takes() + (guess ? fmt::format("; did you mean '{}'?", *guess) : "");
  }
  if (kind == Kind::flag || kind == Kind::text) return {};
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    for (const double x : *numbers)
      if (const auto wrong = complaint(x)) return number_text(x) + " " + *wrong;
    return {};
  }
  const double x = as_number(value);
  if (!std::isfinite(x)) return "is not finite; it must be " + what_it_takes();
  const bool too_low = low && (low->open ? x <= low->value : x < low->value);
  const bool too_high = high && (high->open ? x >= high->value : x > high->value);
  if (too_low || too_high) return "must be " + bounds_text(*this) + (unit.empty() ? "" : " " + unit);
  return {};
}

std::string toml_text(const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return number_text(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    std::vector<std::string> texts;
    for (const double x : *numbers) texts.push_back(number_text(x));
    return "[" + joined(texts, ", ") + "]";
  }
  return quoted(std::get<std::string>(value));
}

std::string default_scene(const ParameterTable& table) {
  std::string out =
      "# Every parameter with its default. Values are in the unit that stands behind them and in no other.\n";
  for (const auto& section : table) {
    // A repeated section has no default: all of it is a comment.
    out += "\n" + with_comment_marks(section.meaning) + (section.repeated ? "# " : "") + heading(section) + "\n";
    for (const auto& p : section.parameters) {
      out += with_comment_marks(p.explained() + (p.range().empty() ? "" : " (" + p.range() + ")"));
      out += assignment(p, section.repeated ? std::nullopt : p.fallback);
    }
  }
  return out;
}

std::string parameter_page(const ParameterTable& table) {
  std::string out;
  for (const auto& section : table) {
    out += fmt::format("{}## `{}`\n\n{}\n\n", out.empty() ? "" : "\n", heading(section), section.meaning);
    out += "| key | default | unit | range | meaning |\n|---|---|---|---|---|\n";
    for (const auto& p : section.parameters)
      out += fmt::format("| `{}.{}` | {} | {} | {} | {} |\n", section.name, p.name, status_of(p), p.unit, p.range(),
                         p.explained());
  }
  return out;
}

const Scene::Entry& Scene::entry(const std::string& key) const {
  const auto found = entries_.find(key);
  if (found == entries_.end()) throw std::logic_error("parameter '" + key + "' is not declared");
  return found->second;
}

template <class T>
const T& Scene::get(const std::string& key, Parameter::Kind kind) const {
  const Entry& e = entry(key);
  if (e.parameter.kind != kind) throw std::logic_error("parameter '" + key + "' is declared with another type");
  if (!e.value) throw std::logic_error("parameter '" + key + "' is read but not set");
  if (!std::holds_alternative<T>(*e.value)) throw std::logic_error("parameter '" + key + "' is given as a word");
  return std::get<T>(*e.value);
}

double Scene::real(const std::string& key) const { return get<double>(key, Parameter::Kind::real); }
std::int64_t Scene::integer(const std::string& key) const { return get<std::int64_t>(key, Parameter::Kind::integer); }
bool Scene::flag(const std::string& key) const { return get<bool>(key, Parameter::Kind::flag); }
const std::string& Scene::choice(const std::string& key) const {
  return get<std::string>(key, Parameter::Kind::choice);
}
const std::string& Scene::text(const std::string& key) const { return get<std::string>(key, Parameter::Kind::text); }

const std::vector<double>& Scene::list(const std::string& key) const {
  return get<std::vector<double>>(key, Parameter::Kind::list);
}

std::size_t Scene::count(const std::string& section) const {
  const auto found = counts_.find(section);
  return found == counts_.end() ? 0 : found->second;
}

void Scene::inherit(const std::string& key, ParameterValue value, const std::string& from) {
  Entry& e = entries_.at(key);
  if (e.origin == Origin::given) return;
  if (const auto wrong = e.parameter.complaint(value))
    throw InputError(fmt::format("{}: {} = {}: {}", from, key, toml_text(value), *wrong));
  e.value = std::move(value);
  e.where = from;
  e.origin = Origin::inherited;
}

bool Scene::is_set(const std::string& key) const { return entry(key).value.has_value(); }

std::optional<std::string> Scene::word(const std::string& key) const {
  const Entry& e = entry(key);
  if (e.parameter.kind != Parameter::Kind::real) throw std::logic_error("parameter '" + key + "' is not a real");
  const auto* word = e.value ? std::get_if<std::string>(&*e.value) : nullptr;
  return word ? std::optional(*word) : std::nullopt;
}

std::string Scene::where(const std::string& key) const { return entry(key).where; }

InputError Scene::error(const std::string& key, const std::string& wrong) const {
  const Entry& e = entry(key);
  const std::string unit = e.parameter.unit.empty() ? "" : " " + e.parameter.unit;
  const std::string value = e.value ? " = " + toml_text(*e.value) + unit : " (not set)";
  return InputError(fmt::format("{}: {}{}: {}", e.where == "default" ? file_ : e.where, key, value, wrong));
}

std::vector<std::string> Scene::keys() const {
  std::vector<std::string> all;
  for (const auto& section : table_) {
    for (std::size_t k = 0; k < (section.repeated ? count(section.name) : 1); ++k)
      for (const auto& p : section.parameters)
        all.push_back(section.name + (section.repeated ? fmt::format("[{}].", k) : ".") + p.name);
  }
  return all;
}

std::string Scene::resolved() const {
  std::string out;
  for (const auto& section : table_) {
    for (std::size_t k = 0; k < (section.repeated ? count(section.name) : 1); ++k) {
      out += fmt::format("{}{}\n", out.empty() ? "" : "\n", heading(section));
      const std::string prefix = section.name + (section.repeated ? fmt::format("[{}].", k) : ".");
      for (const auto& p : section.parameters) out += assignment(p, entry(prefix + p.name).value);
    }
  }
  return out;
}

}  // namespace crumble
