// What a gas makes of a droplet, and which granule that lets expect.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/report.hpp"
#include "dryer/process_inputs.hpp"
#include "dryer/regime.hpp"

namespace crumble::dryer {

struct Conditions {
  ProcessInputs process;                          // of the droplet as the scene has it, its particles left out
  double radius = 0;                              // of it, m
  double particle = 0;                            // radius a of its particles, m
  double diffusivity = 0;                         // D of a particle at half of the lifetime, m^2/s
  double peclet = 0;                              // k/D, k the mean over the lifetime
  std::optional<double> number, solids_fraction;  // of its particles, if the scene says it
  std::optional<DryingRegime> regime;             // with Brownian motion, whatever the scene says
  double packed_time = 0;                         // when the solids fill half of the droplet, s

  // A droplet of fewer particles that stands for it, if it has more than these.
  struct StandIn {
    double number = 0, radius = 0, lifetime = 0;  // -, m, s
    DryingRegime regime;
  };
  std::optional<StandIn> smaller;
};

// Throws InputError if the scene has no [gas] or says too little. fewer: particles of the smaller droplet.
Conditions conditions(const Scene& scene, double fewer);

// For people: a table.
std::string conditions_table(const Conditions& conditions);

// One row for each step of the solution: time_s, radius_m, temperature_k, evaporation_constant_m2_per_s, peclet.
std::string conditions_csv(const Conditions& conditions);
void fill_report(Report& report, const Conditions& conditions);

}  // namespace crumble::dryer
