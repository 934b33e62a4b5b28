// What a run has found, with its error and its cost, as JSON for tables and tests. One shape for every program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/io/cost.hpp"
#include "common/io/parameters.hpp"

namespace crumble {

// Begin it where the work begins: wall time counts from there, CPU time and peak memory are the whole process's, and
// what earlier processes of the same run used is added.
class Report {
 public:
  // Nothing (null in JSON) says that there is no such number.
  using Value =
      std::variant<std::nullptr_t, std::int64_t, double, std::string, std::vector<double>, std::vector<std::int64_t>>;

  Report(std::string program, std::string version, std::string scene, std::optional<std::int64_t> seed);

  void add_earlier(const Cost& cost) { meter_.add_earlier(cost); }

  std::int64_t steps = 0;
  std::vector<std::string> left_out;  // what the scene made unnecessary, and why that is allowed

  // Names carry the unit where there is one ("d_c_nm"); a dot puts a value into a group ("shear.n_max_orbit"). A value
  // that is not finite throws.
  void result(const std::string& name, Value value);
  // `value` is the error in the unit of the name ("d_c_relative"); nothing if it was not estimated. `how` says in words
  // how it was estimated, or why not.
  void error(const std::string& name, std::optional<double> value, const std::string& how);

  // A parameter of the scene, by its full name; nothing if it is not set.
  void input(const std::string& key, std::optional<ParameterValue> value);
  // One that travels with the granule: what it is taken from ("scene", "file", "default") and what the file says.
  void granule(const std::string& key, std::optional<ParameterValue> value, const std::string& from,
               std::optional<double> in_file);

  std::string json() const;
  // A half-written report never looks finished. No name: none is wanted.
  void write(const std::string& file) const;

 private:
  struct Travelling {
    std::string key;
    std::optional<ParameterValue> value;
    std::string from;
    std::optional<double> in_file;
  };
  struct Error {
    std::string name;
    std::optional<double> value;
    std::string how;
  };
  std::string program_, version_, scene_;
  std::optional<std::int64_t> seed_;
  CostMeter meter_;
  std::vector<std::pair<std::string, Value>> results_;
  std::vector<Error> errors_;
  std::vector<std::pair<std::string, std::optional<ParameterValue>>> inputs_;
  std::vector<Travelling> granule_;
};

}  // namespace crumble
