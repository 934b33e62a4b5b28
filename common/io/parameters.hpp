// The parameters of a scene. Each is declared once (name, unit, default, range, meaning); reading and checking a TOML
// scene, the file of defaults, the reference page and the resolved scene all come from that declaration.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/io/errors.hpp"

namespace crumble {

using ParameterValue = std::variant<double, std::int64_t, bool, std::string, std::vector<double>>;

// Values are in the declared unit and in no other. A parameter is required unless it has a default or is optional
// (then the program asks `Scene::is_set`). Use optional for alternatives, of which the program checks that one is
// given.
class Parameter {
 public:
  static Parameter real(std::string name, std::string unit, std::string meaning);
  static Parameter integer(std::string name, std::string meaning);
  static Parameter flag(std::string name, std::string meaning);
  static Parameter choice(std::string name, std::vector<std::string> choices, std::string meaning);
  static Parameter text(std::string name, std::string meaning);
  static Parameter list(std::string name, std::string unit, std::string meaning);  // of reals

  Parameter by_default(double value) const;
  Parameter by_default(int value) const;
  Parameter by_default(bool value) const;
  Parameter by_default(const char* value) const;
  Parameter optional() const;

  // A real may also be named by one of these words, of which the program knows the number: viscosity = "water".
  Parameter or_word(std::vector<std::string> words) const;

  // A real may be given by another key of its section, whose value times `factor` it is: a radius by a diameter, 0.5.
  // One way of the two, not both.
  Parameter or_by(std::string other, double factor) const;
  // Full name by which others call it: in a scene an error that says what it is called here.
  Parameter not_called(std::string key) const;

  // The full name by which earlier versions called it. In a scene that is an error that says so.
  Parameter formerly(std::string key) const;

  // Range of a real, an integer or each number of a list.
  Parameter above(double bound) const;
  Parameter at_least(double bound) const;
  Parameter below(double bound) const;
  Parameter at_most(double bound) const;

  enum class Kind { real, integer, flag, choice, text, list };
  struct Bound {
    double value;
    bool open;
  };

  std::string name, unit, meaning;
  Kind kind = Kind::real;
  std::vector<std::string> choices;  // of a choice; words of a real
  struct Synonym {
    std::string name;
    double factor;
  };
  std::vector<Synonym> synonyms;
  std::vector<std::string> former, wrong_names;
  std::optional<ParameterValue> fallback;
  bool is_optional = false;
  std::optional<Bound> low, high;

  std::string explained() const;      // meaning and synonyms
  std::string range() const;          // "> 0", "0 to 0.5", "jkr or cundall-strack"; empty if anything goes
  std::string what_it_takes() const;  // "a number > 0 in m"
  // What is wrong with a value of the right kind ("must be > 0"), or nothing.
  std::optional<std::string> complaint(const ParameterValue& value) const;

 private:
  Parameter with_default(ParameterValue value) const;
};

struct Section {
  std::string name, meaning;
  std::vector<Parameter> parameters;
  bool repeated = false;                 // written [[name]], any number of times; its keys are "name[0].key" and so on
  std::vector<std::string> former = {};  // full names of keys of earlier versions in whose place it stands
};
using ParameterTable = std::vector<Section>;

// TOML text of a value; doubles are written with the fewest digits that read back to the same bits.
std::string toml_text(const ParameterValue& value);

// A complete commented scene with every default; what has none stands as a comment.
std::string default_scene(const ParameterTable& table);

// The reference page: one table a section, in Markdown.
std::string parameter_page(const ParameterTable& table);

// The candidate nearest to `word` by edit distance, unless all are too far to be meant.
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& candidates);

// A value given on the command line. `origin` is what messages call it: "--set", "--seed".
struct Override {
  std::string key, value, origin;
};

// Splits the argument of --set.
Override parse_override(const std::string& argument);

// A scene read and checked against a table. All that is wrong is reported at once, one line each, as an InputError.
class Scene {
 public:
  static Scene read(const std::string& file, const ParameterTable& table, const std::vector<Override>& overrides = {});
  static Scene parse(const std::string& text, const std::string& file, const ParameterTable& table,
                     const std::vector<Override>& overrides = {});
  // A resolved scene out of a file, perhaps of an earlier version: former names are understood.
  static Scene parse_stored(const std::string& text, const std::string& file, const ParameterTable& table);

  // Takes `value` where the scene says nothing, in place of the default; `from` is what messages call its source. A
  // value that the declaration does not allow is an InputError.
  void inherit(const std::string& key, ParameterValue value, const std::string& from);

  // By full name, "section.name". Asking for what the table does not declare so is an error of ours (std::logic_error),
  // and so is reading an optional parameter that is not set.
  double real(const std::string& key) const;
  std::int64_t integer(const std::string& key) const;
  bool flag(const std::string& key) const;
  const std::string& choice(const std::string& key) const;
  const std::string& text(const std::string& key) const;
  const std::vector<double>& list(const std::string& key) const;
  bool declares(const std::string& key) const { return entries_.contains(key); }
  // How often a repeated section stands in the scene.
  std::size_t count(const std::string& section) const;
  bool is_set(const std::string& key) const;
  // The word that stands for a real, if it was given one.
  std::optional<std::string> word(const std::string& key) const;

  const std::optional<ParameterValue>& value(const std::string& key) const { return entry(key).value; }

  // Where the value comes from: "drying.toml:14", "--set", "default" or what inherit() said.
  std::string where(const std::string& key) const;
  enum class Origin { given, inherited, by_default };
  Origin origin(const std::string& key) const { return entry(key).origin; }
  // For relations between parameters: "drying.toml:14: droplet.radius = 1e-09 m: <what is wrong>".
  InputError error(const std::string& key, const std::string& wrong) const;

  const std::string& file() const { return file_; }
  const ParameterTable& table() const { return table_; }
  // Full names in the order of the table, those of repeated sections with their numbers.
  std::vector<std::string> keys() const;
  const std::string& given() const { return given_; }  // the text as it stood in the file
  std::string resolved() const;                        // TOML with every value; reads back to the same values

 private:
  struct Entry {
    Parameter parameter;
    std::optional<ParameterValue> value;
    std::string where;
    Origin origin = Origin::given;
  };
  friend class SceneReader;

  const Entry& entry(const std::string& key) const;
  template <class T>
  const T& get(const std::string& key, Parameter::Kind kind) const;

  std::string file_, given_;
  ParameterTable table_;
  std::map<std::string, Entry> entries_;
  std::map<std::string, std::size_t> counts_;  // of repeated sections
};

}  // namespace crumble
