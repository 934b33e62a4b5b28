#include "dryer/gas/evaporation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dryer/gas/water_saturation.hpp"

namespace crumble::dryer {

namespace {

// R^2, T, mass evaporated, enthalpy received. The slopes depend on the first two alone, and on the gas.
using State = std::array<double, 4>;

State slope(const State& y, const Gas& gas, const SmallDroplet& small) {
  const double R = std::sqrt(y[0]), T = y[1];
  const Film film = film_of(R, T, gas, small);
  const double density = saturated_water_density(T), volume = 4.0 / 3 * std::numbers::pi * R * R * R;
  const double warming = (film.heat - latent_heat(T) * film.evaporation) / (density * volume * water_heat_capacity);
  const double growth = -film.evaporation / density - volume * saturated_water_density_slope(T) / density * warming;
  return {growth / (2 * std::numbers::pi * R), warming, film.evaporation,
          film.heat - (latent_heat(T) + water_heat_capacity * T) * film.evaporation};
}

State plus(State y, double factor, const State& k) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += factor * k[i];
  return y;
}

// Slopes about a state and an instant within one interval of the history.
struct Linear {
  State by_square, by_temperature, by_time;
};
template <class Slope>
Linear linear(const Slope& slope, double time, const State& y, double dt) {
  const auto difference = [](const State& up, const State& down, double way) {
    return plus(plus(State{}, 1 / way, up), -1 / way, down);
  };
  const double d0 = 1e-6 * y[0], d1 = 1e-6 * y[1], dt_small = 1e-3 * dt;
  return {difference(slope(time, {y[0] + d0, y[1]}), slope(time, {y[0] - d0, y[1]}), 2 * d0),
          difference(slope(time, {y[0], y[1] + d1}), slope(time, {y[0], y[1] - d1}), 2 * d1),
          difference(slope(time + dt_small, y), slope(time - dt_small, y), 2 * dt_small)};
}

struct Step {
  State end;
  double error = 0;  // over the tolerance
};

// One step of Shampine's (1982) coefficients of the Rosenbrock method of Kaps & Rentrop (1979): orders 4 and 3,
// A-stable. A state in which the water boils gives an error that is not a number.
template <class Slope>
Step try_step(const Slope& slope, double time, const State& y, const State& first, const Linear& J, double dt,
              double tolerance) {
  constexpr double gamma = 0.5;
  const double p = 1 / (gamma * dt);
  // (p - J) g = rhs: two equations for R^2 and T, the others follow.
  const auto solved = [&](const State& rhs) {
    const double a = p - J.by_square[0], b = -J.by_temperature[0], c = -J.by_square[1], d = p - J.by_temperature[1];
    const double determinant = a * d - b * c;
    State g{(d * rhs[0] - b * rhs[1]) / determinant, (a * rhs[1] - c * rhs[0]) / determinant, 0, 0};
    for (const std::size_t i : {2, 3}) g[i] = (rhs[i] + J.by_square[i] * g[0] + J.by_temperature[i] * g[1]) / p;
    return g;
  };
  const State g1 = solved(plus(first, 0.5 * dt, J.by_time));
  const State f2 = slope(time + dt, plus(y, 2, g1));
  const State g2 = solved(plus(plus(f2, -1.5 * dt, J.by_time), -8 / dt, g1));
  const State f3 = slope(time + 0.6 * dt, plus(plus(y, 48. / 25, g1), 6. / 25, g2));
  const State g3 = solved(plus(plus(plus(f3, 121. / 50 * dt, J.by_time), 372. / 25 / dt, g1), 12. / 5 / dt, g2));
  const State g4 = solved(plus(
      plus(plus(plus(f3, 29. / 250 * dt, J.by_time), -112. / 125 / dt, g1), -54. / 125 / dt, g2), -2. / 5 / dt, g3));
  const State end = plus(plus(plus(plus(y, 19. / 9, g1), 1. / 2, g2), 25. / 108, g3), 125. / 108, g4);
  const State error = plus(plus(plus(State{}, 17. / 54, g1), 7. / 36, g2), 125. / 108, g4);
  return {end, std::max(std::abs(error[0]) / end[0], std::abs(error[1]) / end[1]) / tolerance};
}

}  // namespace

std::size_t GasHistory::passed(double time) const {
  return static_cast<std::size_t>(std::upper_bound(time_.begin(), time_.end(), time) - time_.begin());
}

Gas GasHistory::at(double time, std::size_t passed) const {
  if (passed == 0) return gas_.front();
  if (passed == time_.size()) return gas_.back();
  const Gas &a = gas_[passed - 1], &b = gas_[passed];
  const double x = (time - time_[passed - 1]) / (time_[passed] - time_[passed - 1]);
  return {a.temperature + x * (b.temperature - a.temperature),
          a.vapour_mass_fraction + x * (b.vapour_mass_fraction - a.vapour_mass_fraction),
          std::max(a.slip + x * (b.slip - a.slip), 0.0), a.pressure + x * (b.pressure - a.pressure)};
}

Evaporation evaporation(const EvaporatingDroplet& droplet, const GasHistory& gas, double tolerance) {
  if (relative_humidity(gas.last()) >= 1 - 1e-9)
    throw std::domain_error("the gas is saturated with vapour: a droplet does not dry in it");
  std::size_t passed = gas.passed(0);
  const auto slope_at = [&](double t, const State& y) { return slope(y, gas.at(t, passed), droplet.small); };
  State y{droplet.radius * droplet.radius, droplet.temperature, 0, 0};
  State now = slope_at(0, y);
  if (!std::isfinite(now[1]))
    throw std::domain_error(fmt::format("at its start, {:.2f} K, the droplet boils", droplet.temperature));
  const auto change = [&] { return std::max(std::abs(now[0]) / y[0], 1e-300); };
  double time = 0, dt = 1e-6 / std::max(change(), std::abs(now[1]) / y[1]);
  std::vector<DryingCurve::Node> nodes{{0, y[0], now[0], y[1], now[1]}};
  constexpr int most_steps = 200000;
  const double last_square = droplet.last_radius * droplet.last_radius;
  for (int step = 0; y[0] > last_square * (1 + 1e-9); ++step) {
    if (step == most_steps)
      throw std::domain_error(fmt::format("after {:.3g} s the droplet has still not dried", time));
    // No step changes R^2 by more than a tenth; steps end at the instants of the history and aim at last_radius.
    dt = std::min(dt, 0.1 / change());
    if (now[0] < 0) dt = std::min(dt, (y[0] - last_square) / -now[0]);
    const bool ends = passed < gas.times().size() && gas.times()[passed] - time <= dt;
    const double tried = ends ? gas.times()[passed] - time : dt;
    const Step next = try_step(slope_at, time, y, now, linear(slope_at, time, y, tried), tried, tolerance);
    const double factor =
        std::isfinite(next.error) ? std::clamp(0.9 * std::pow(std::max(next.error, 1e-10), -0.25), 0.2, 3.0) : 0.2;
    if (!(next.error <= 1)) {
      dt = tried * factor;
      if (!(tried > 1e-14 * time)) throw std::domain_error(fmt::format("at {:.3g} s the droplet boils", time));
      continue;
    }
    time = ends ? gas.times()[passed] : time + tried;
    dt = ends ? std::max(dt, tried * factor) : tried * factor;
    passed = gas.passed(time);
    y = next.end, now = slope_at(time, y);
    if (y[1] < water_triple_point)
      throw std::domain_error(
          fmt::format("at {:.3g} s the droplet has come below {} K and freezes, which is not known here", time,
                      water_triple_point));
    nodes.push_back({time, y[0], now[0], y[1], now[1]});
  }
  if (!(now[0] < 0)) throw std::domain_error("the last of the droplet does not evaporate");
  const std::size_t known = nodes.size();
  nodes.back().warming = 0;
  nodes.push_back({time - y[0] / now[0], 0, now[0], y[1], 0});
  return {DryingCurve(std::move(nodes)), y[2], y[3], known};
}

double heat_up_time(double R, double temperature, double gas_conductivity) {
  return saturated_water_density(temperature) * water_heat_capacity * R * R / (3 * gas_conductivity);
}

}  // namespace crumble::dryer
