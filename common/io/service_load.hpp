// What a granule must bear in a device, and whether it does: the answer to --at.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/io/report.hpp"

namespace crumble {

// The liquid in which the granule is loaded.
struct Liquid {
  double viscosity = 0;                                                  // mu, Pa s
  double density = 0;                                                    // rho, kg/m^3
  double shear_rate(double stress) const { return stress / viscosity; }  // 1/s at a flow stress mu gamma_dot in Pa
};

struct ServiceLoad {
  std::string given;      // as typed
  double stress = 0;      // mu gamma_dot, Pa
  double shear_rate = 0;  // 1/s
  // Of turbulence only: the dissipation rate, W/kg, and the Kolmogorov length, m.
  std::optional<double> dissipation, eddies;
};

// "100 Pa" (flow stress), "1e4 1/s" (shear rate sqrt(2 E:E)) or "10 W/kg" (turbulent dissipation rate; the shear rate
// is sqrt(epsilon/nu)). Throws InputError on anything else.
ServiceLoad service_load(const std::string& text, const Liquid& liquid);

// The same of an option; nothing where it was not given.
std::optional<ServiceLoad> service_load_at(const std::string& text, const Liquid& liquid);

// Which device has this flow, for a table.
std::string_view device_of(std::string_view flow);

// What is known about the strength of one granule.
struct GranuleStrength {
  std::optional<double> stress;     // at which it breaks, Pa; nothing: no contact can break, or none did
  double borne = 0;                 // Pa, where nothing broke: the largest that was tried
  std::string flow;                 // in which
  std::optional<double> error;      // relative, numerical
  std::string how;                  // it was estimated, or why not
  double surface_energy = 0;        // J/m^2
  std::string surface_energy_from;  // scene, file or default
  double diameter = 0;              // of the granule, m
};

enum class Verdict { holds, breaks, undecided };  // undecided: the numerical error says so, or nothing was tried so far
Verdict verdict(const ServiceLoad& load, const GranuleStrength& strength);

// One sentence with the three errors side by side, and another where the flow is not linear at the granule's size.
std::string answer_text(const ServiceLoad& load, const GranuleStrength& strength);
// The same under `at` in the report; returns the sentence.
std::string report_service(Report& report, const ServiceLoad& load, const GranuleStrength& strength);

}  // namespace crumble
