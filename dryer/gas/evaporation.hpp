// The course of a droplet in a gas that may change: radius and temperature in time.
#pragma once

#include <vector>

#include "dryer/drying_curve.hpp"
#include "dryer/gas/film.hpp"

namespace crumble::dryer {

// The gas around the droplet in time: linear between its instants, and the last one stays.
class GasHistory {
 public:
  explicit GasHistory(const Gas& constant) : time_{0}, gas_{constant} {}
  GasHistory(std::vector<double> time, std::vector<Gas> gas) : time_(std::move(time)), gas_(std::move(gas)) {}

  Gas at(double time) const { return at(time, passed(time)); }
  // How many instants are not after `time`; with the number of the instant at which a step begins, at() goes straight
  // on beyond the next one.
  std::size_t passed(double time) const;
  Gas at(double time, std::size_t passed) const;
  const std::vector<double>& times() const { return time_; }
  const Gas& first() const { return gas_.front(); }
  const Gas& last() const { return gas_.back(); }

 private:
  std::vector<double> time_;  // ascending from 0, s
  std::vector<Gas> gas_;
};

struct EvaporatingDroplet {
  double radius = 0;        // at the start, m
  double temperature = 0;   // at the start, K
  double last_radius = 0;   // below it R^2 falls on at the rate that it has there, m: that of a particle
  SmallDroplet small = {};  // which corrections hold
};

struct Evaporation {
  DryingCurve curve;
  // Totals from the start until last_radius, for the balances.
  double evaporated = 0;  // kg
  double enthalpy = 0;    // heat received less what the vapour has carried away, enthalpies from 0 K of c_l T, J
  std::size_t nodes_to_last_radius = 0;
};

// With the film of film.hpp at every instant, and one temperature in the droplet:
//   d(rho_l V)/dt = -|dm/dt|,   rho_l V c_l dT/dt = Q - L |dm/dt|
// in R^2 and T; the droplet is all water. Rosenbrock steps of orders 4 and 3, local errors below `tolerance` of R^2 and
// of T, ending at the instants of the history. The temperature relaxes some 40 times while R^2 falls by 1/e in a gas of
// 150 C, 400 times in a room and more in moist gas, which makes the system stiff.
// Throws std::domain_error saying what happens if the droplet freezes, boils or does not dry.
Evaporation evaporation(const EvaporatingDroplet& droplet, const GasHistory& gas, double tolerance = 1e-8);

// Time in which conduction alone warms a droplet, rho_l c_l R^2/(3 k_g), s: how long its temperature takes to settle.
double heat_up_time(double R, double temperature, double gas_conductivity);

}  // namespace crumble::dryer
