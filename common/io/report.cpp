#include "common/io/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/io/output_file.hpp"

namespace crumble {
namespace {

void require_finite(const std::string& name, double x) {
  if (!std::isfinite(x)) throw std::runtime_error(fmt::format("report: '{}' is {}, not a finite number", name, x));
}

// "shear.n_max" -> the entry n_max of the object shear.
nlohmann::ordered_json& place(nlohmann::ordered_json& results, const std::string& name) {
  const auto dot = name.find('.');
  return dot == std::string::npos ? results[name] : place(results[name.substr(0, dot)], name.substr(dot + 1));
}

nlohmann::ordered_json as_json(const std::optional<ParameterValue>& value) {
  if (!value) return nullptr;
  return std::visit([](const auto& x) { return nlohmann::ordered_json(x); }, *value);
}

// Largest resident memory of this program, bytes. Not that of getrusage, which goes on from the program that started
// this one. -1 where the system does not tell.
std::int64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::int64_t kilobytes = 0; word == "VmHWM:" && status >> kilobytes) return kilobytes * 1024;
  return -1;
}

}  // namespace

Report::Report(std::string program, std::string version, std::string scene, std::optional<std::int64_t> seed)
    : program_(std::move(program)), version_(std::move(version)), scene_(std::move(scene)), seed_(seed) {}

void Report::result(const std::string& name, Value value) {
  if (const auto* x = std::get_if<double>(&value)) require_finite(name, *x);
  if (const auto* list = std::get_if<std::vector<double>>(&value))
    for (const double x : *list) require_finite(name, x);
  results_.emplace_back(name, std::move(value));
}

void Report::error(const std::string& name, std::optional<double> value, const std::string& how) {
  if (value) require_finite(name, *value);
  errors_.push_back({name, value, how});
}

void Report::input(const std::string& key, std::optional<ParameterValue> value) {
  inputs_.emplace_back(key, std::move(value));
}

void Report::granule(const std::string& key, std::optional<ParameterValue> value, const std::string& from,
                     std::optional<double> in_file) {
  granule_.push_back({key, std::move(value), from, in_file});
}

std::string Report::json() const {
  nlohmann::ordered_json out;
  out["program"] = program_;
  out["version"] = version_;
  out["scene"] = scene_;
  if (seed_)
    out["seed"] = *seed_;
  else
    out["seed"] = nullptr;
  for (const auto& [key, value] : inputs_) place(out["inputs"], key) = as_json(value);
  for (const Travelling& t : granule_) {
    auto& entry = place(out["granule"], t.key);
    entry["value"] = as_json(t.value ? t.value : t.in_file ? std::optional<ParameterValue>(*t.in_file) : std::nullopt);
    entry["from"] = t.from;
    if (t.in_file) entry["in_file"] = *t.in_file;
  }
  const Cost cost = meter_.used();
  out["wall_s"] = cost.wall_s;
  out["cpu_s"] = cost.cpu_s;
  out["peak_rss_bytes"] = peak_memory();
  out["steps"] = steps;
  out["results"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : results_)
    std::visit([&, &key = name](const auto& x) { place(out["results"], key) = x; }, value);
  out["errors"] = nlohmann::ordered_json::object();
  for (const auto& e : errors_) {
    auto& entry = out["errors"][e.name];
    if (e.value)
      entry["value"] = *e.value;
    else
      entry["value"] = nullptr;
    entry["how"] = e.how;
  }
  out["left_out"] = left_out;
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void Report::write(const std::string& file) const {
  if (!file.empty()) write_text_file(file, json());
}

}  // namespace crumble
