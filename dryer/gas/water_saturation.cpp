#include "dryer/gas/water_saturation.hpp"

#include <cmath>

#include "dryer/water_surface_tension.hpp"

namespace crumble::dryer {

namespace {

constexpr double critical_pressure = 22.064e6, critical_density = 322;  // Pa, kg/m^3

struct Term {
  double factor, power;
};
constexpr Term pressure_terms[]{{-7.85951783, 1},  {1.84408259, 1.5},  {-11.7866497, 3},
                                {22.6807411, 3.5}, {-15.9618719, 4.0}, {1.80122502, 7.5}};
constexpr Term water_terms[]{{1.99274064, 1. / 3},   {1.09965342, 2. / 3},   {-0.510839303, 5. / 3},
                             {-1.75493479, 16. / 3}, {-45.5170352, 43. / 3}, {-6.74694450e5, 110. / 3}};
constexpr Term vapour_terms[]{{-2.03150240, 2. / 6},  {-2.68302940, 4. / 6},  {-5.38626492, 8. / 6},
                              {-17.2991605, 18. / 6}, {-44.7586581, 37. / 6}, {-63.9201063, 71. / 6}};

double theta_at(double T) { return 1 - T / water_critical_temperature; }

template <std::size_t n>
double sum(const Term (&terms)[n], double theta) {
  double all = 0;
  for (const Term& term : terms) all += term.factor * std::pow(theta, term.power);
  return all;
}

template <std::size_t n>
double slope(const Term (&terms)[n], double theta) {
  double all = 0;
  for (const Term& term : terms) all += term.factor * term.power * std::pow(theta, term.power - 1);
  return all;
}

}  // namespace

double saturation_pressure(double T) {
  return critical_pressure * std::exp(water_critical_temperature / T * sum(pressure_terms, theta_at(T)));
}

double saturation_pressure_slope(double T) {
  const double theta = theta_at(T);
  return -saturation_pressure(T) / T *
         (water_critical_temperature / T * sum(pressure_terms, theta) + slope(pressure_terms, theta));
}

double saturated_water_density(double T) { return critical_density * (1 + sum(water_terms, theta_at(T))); }

double saturated_water_density_slope(double T) {
  return -critical_density / water_critical_temperature * slope(water_terms, theta_at(T));
}

double saturated_vapour_density(double T) { return critical_density * std::exp(sum(vapour_terms, theta_at(T))); }

double latent_heat(double T) {
  return T * (1 / saturated_vapour_density(T) - 1 / saturated_water_density(T)) * saturation_pressure_slope(T);
}

// ln p is nearly straight in 1/T: Newton's method on it.
double saturation_temperature(double pressure) {
  double T = 373.15;
  for (int k = 0; k < 100; ++k) {
    const double p = saturation_pressure(T),
                 x = 1 / T - std::log(pressure / p) * p / (T * T * saturation_pressure_slope(T));
    const double next = std::fmin(1 / x, 0.5 * (T + water_critical_temperature));
    if (std::abs(next - T) < 1e-13 * T) return next;
    T = next;
  }
  return T;
}

}  // namespace crumble::dryer
