#include "common/io/service_load.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "common/hydro/turbulence.hpp"
#include "common/io/errors.hpp"

namespace crumble {

namespace {

struct Measure {
  double value;
  std::string unit;
};

Measure measure_in(const std::string& text) {
  Measure m{};
  const char* begin = text.data();
  const char* const end = begin + text.size();
  while (begin < end && *begin == ' ') ++begin;
  const auto [rest, problem] = std::from_chars(begin, end, m.value);
  if (problem == std::errc())
    for (const char* c = rest; c < end; ++c)
      if (*c != ' ') m.unit += *c;
  if (problem != std::errc() || !(m.value > 0) || !std::isfinite(m.value)) m.unit.clear();
  return m;
}

const char* word(Verdict v) { return v == Verdict::holds ? "holds" : v == Verdict::breaks ? "breaks" : "not decided"; }

std::string numerical(const GranuleStrength& s) {
  return s.error ? fmt::format("numerical {:.2g} % ({})", 100 * *s.error, s.how)
                 : fmt::format("numerical not known ({})", s.how);
}

constexpr const char* sampling =
    "not known from one granule: load several, dried from other seeds, and compare their strengths";

std::string material(const ServiceLoad& load, const GranuleStrength& s) {
  std::string text = fmt::format("material in proportion to the surface energy, {:g} J/m2 ({})", s.surface_energy,
                                 s.surface_energy_from);
  if (s.stress)
    text += fmt::format(": with {:.2g} J/m2 it would break just here", s.surface_energy * load.stress / *s.stress);
  return text;
}

}  // namespace

ServiceLoad service_load(const std::string& text, const Liquid& liquid) {
  const Measure m = measure_in(text);
  ServiceLoad load{text, 0, 0, {}, {}};
  if (m.unit == "Pa") {
    load.stress = m.value;
    load.shear_rate = liquid.shear_rate(m.value);
  } else if (m.unit == "1/s" || m.unit == "s-1") {
    load.shear_rate = m.value;
    load.stress = liquid.viscosity * m.value;
  } else if (m.unit == "W/kg") {
    const double nu = liquid.viscosity / liquid.density;
    load.dissipation = m.value;
    load.shear_rate = kolmogorov_shear_rate(m.value, nu);
    load.stress = liquid.viscosity * load.shear_rate;
    load.eddies = kolmogorov_length(m.value, nu);
  } else {
    throw InputError(fmt::format(
        "--at '{}': must be a number > 0 with its unit: \"100 Pa\" (flow stress), \"1e4 1/s\" (shear rate in the "
        "liquid of [fluid]) or \"10 W/kg\" (dissipation rate of turbulence)",
        text));
  }
  return load;
}

std::optional<ServiceLoad> service_load_at(const std::string& text, const Liquid& liquid) {
  return text.empty() ? std::nullopt : std::optional(service_load(text, liquid));
}

std::string_view device_of(std::string_view flow) {
  if (flow == "shear") return "stirred tank (laminar), rotor-stator gap";
  if (flow == "uniaxial") return "extensional nozzle, contraction";
  if (flow == "biaxial") return "impinging jets, squeezing";
  if (flow == "elongation") return "stagnation flow, calender";
  if (flow == "turbulence") return "turbulence, at sqrt(epsilon/nu)";
  return "";
}

Verdict verdict(const ServiceLoad& load, const GranuleStrength& s) {
  if (!s.stress) return load.stress <= s.borne ? Verdict::holds : Verdict::undecided;
  const double use = load.stress / *s.stress, error = s.error.value_or(0);
  if (use * (1 + error) < 1) return Verdict::holds;
  return use * (1 - error) >= 1 ? Verdict::breaks : Verdict::undecided;
}

std::string answer_text(const ServiceLoad& load, const GranuleStrength& s) {
  std::string text = fmt::format("{}", load.given);
  if (load.given.find("Pa") == load.given.npos) text += fmt::format(" = {:.3g} Pa", load.stress);
  if (load.given.find("/s") == load.given.npos) text += fmt::format(" = {:.3g} 1/s in this liquid", load.shear_rate);
  text += fmt::format(": {}, ", word(verdict(load, s)));
  if (s.stress)
    text += fmt::format("at {:.2g} % of its strength of {:.4g} Pa in {}; ", 100 * load.stress / *s.stress, *s.stress,
                        s.flow);
  else
    text += std::isinf(s.borne) ? fmt::format("no contact can break in {}; ", s.flow)
                                : fmt::format("nothing broke up to {:.4g} Pa in {}; ", s.borne, s.flow);
  text += fmt::format("errors: {}; sampling {}; {}.\n", numerical(s), sampling, material(load, s));
  if (load.eddies && s.diameter > *load.eddies)
    text += fmt::format(
        "The granule ({:.3g} um) is larger than the Kolmogorov length ({:.3g} um): the flow is not linear about it, "
        "and this answer does not hold.\n",
        1e6 * s.diameter, 1e6 * *load.eddies);
  return text;
}

std::string report_service(Report& report, const ServiceLoad& load, const GranuleStrength& s) {
  const auto maybe = [](const std::optional<double>& x) { return x ? Report::Value(*x) : Report::Value(nullptr); };
  report.result("at.given", load.given);
  report.result("at.stress_pa", load.stress);
  report.result("at.shear_rate_per_s", load.shear_rate);
  report.result("at.kolmogorov_length_m", maybe(load.eddies));
  report.result("at.flow", s.flow);
  report.result("at.strength_pa", maybe(s.stress));
  report.result("at.verdict", std::string(word(verdict(load, s))));
  report.result("at.share_of_strength", s.stress ? Report::Value(load.stress / *s.stress) : Report::Value(nullptr));
  report.result("at.error_numerical_relative", maybe(s.error));
  report.result("at.error_sampling_relative", nullptr);
  report.result("at.surface_energy_j_per_m2", s.surface_energy);
  report.result("at.surface_energy_to_break_j_per_m2",
                s.stress ? Report::Value(s.surface_energy * load.stress / *s.stress) : Report::Value(nullptr));
  const std::string sentence = answer_text(load, s);
  report.result("at.sentence", sentence);
  return sentence;
}

}  // namespace crumble
