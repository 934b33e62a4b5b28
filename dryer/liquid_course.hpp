// The liquid of a droplet whose temperature changes, in pieces of time in which its properties stand.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "dryer/drying_curve.hpp"
#include "dryer/model.hpp"

namespace crumble::dryer {

struct LiquidPiece {
  double until = 0;            // s, of the time without a crust (Front::reduced); infinity in the last
  double temperature = 0;      // K
  double viscosity = 0;        // Pa s
  double surface_tension = 0;  // N/m, times wetting_factor()
  double thermal_energy = 0;   // kT, J; 0 without Brownian motion
};

// A new piece where the temperature has moved by this much, K: properties are those of the middle, within a quarter of
// a kelvin of the liquid's. Water's viscosity changes by 2.5 % a kelvin at 0 C and by 1 % at 100 C: within 0.6 %.
inline constexpr double piece_of_temperature = 0.5;

// Ends and temperatures of the pieces; properties are filled in by `properties`.
std::vector<LiquidPiece> liquid_course(const DryingCurve& curve, const std::function<void(LiquidPiece&)>& properties);

// How many pieces from this one on are over at the time.
std::size_t pieces_passed(const std::vector<LiquidPiece>& pieces, std::size_t from, double time);

// The piece at the time.
const LiquidPiece& piece_at(const std::vector<LiquidPiece>& pieces, double time);

void take(const LiquidPiece& piece, DryingModel& model);

}  // namespace crumble::dryer
