// What a scene says about the gas around its droplet, and what follows from it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/io/output_file.hpp"
#include "common/io/parameters.hpp"
#include "dryer/gas/evaporation.hpp"

namespace crumble::dryer {

Section gas_section();
// Of [droplet], where there is a [gas].
Parameter initial_temperature_parameter();
// Of [stands_for].
Parameter real_radius_parameter();

struct GasSide {
  GasHistory gas;
  EvaporatingDroplet droplet;                // the real one
  Evaporation course;                        // of the real one
  double size = 1, pace = 1;                 // lengths and times of the droplet that is dried, in those of the real one
  std::shared_ptr<const DryingCurve> curve;  // of the one that is dried

  double wet_bulb = 0, last_wet_bulb = 0;  // of the real droplet at its start, in the first and in the last gas, K
  double evaporation_constant = 0;         // k at the wet bulb in the first gas, m^2/s
  double humidity = 0, dew = 0;            // relative humidity and dew point of the first gas, -, K
  double heat_up_time = 0;                 // s, heat_up_time() of the real droplet in the first gas
  double largest_radius = 0;               // of the real droplet: above droplet.radius where vapour condenses on it, m
  double vapour_knudsen = 0, kelvin = 0;   // Kn of the vapour and Kelvin's factor less 1 at the start
};

bool has_gas(const Scene& scene);
// The key that brings it in, for messages: gas.temperature or gas.history.
std::string gas_key(const Scene& scene);
// The CSV file of the history, if there is one.
std::vector<ReadFile> gas_files(const Scene& scene);

// Where a scene with [gas] says nothing of the liquid it is water, not the paper's model liquid.
void inherit_from_gas(Scene& scene);

// Throws InputError naming file, line, keys and remedy: two humidities or none, a gas below its dew point, a droplet
// that freezes, boils or never dries, a history that does not increase.
GasSide gas_side(const Scene& scene);

// A table of a droplet's track: header t, temperature, vapour_mass_fraction, and slip if there is any; units in
// brackets are checked. s, K, kg/kg, m/s; from t = 0.
GasHistory read_gas_history(const std::string& text, const std::string& file, double pressure);

// For people, a line each.
std::vector<std::string> describe(const GasSide& side);

}  // namespace crumble::dryer
