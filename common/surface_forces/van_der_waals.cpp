#include "common/surface_forces/van_der_waals.hpp"

#include <cmath>
#include <numbers>

namespace crumble {

namespace {

// [p/s + p/d + ln(s/d)] with x = 1 - s/d = 2 p/d; where x is small its terms cancel up to x^3/6.
double bracket(double p, double s, double d) {
  const double x = 2 * p / d;
  if (x > 0.02) return p / s + p / d + std::log(s / d);
  double power = x * x * x, sum = 0;
  for (int n = 3; n < 12; ++n, power *= x) sum += power * (0.5 - 1.0 / n);
  return sum;
}

}  // namespace

double VanDerWaals::energy(double h) const {
  const double a1 = radius_1, a2 = radius_2, p = 2 * a1 * a2;
  const double s = h * (2 * (a1 + a2) + h), d = s + 2 * p;
  return -hamaker / 6 * bracket(p, s, d) / (1 + retardation_rate * h);
}

double VanDerWaals::tension(double h) const {
  const double a1 = radius_1, a2 = radius_2, p = 2 * a1 * a2, r = a1 + a2 + h;
  const double s = h * (2 * (a1 + a2) + h), d = s + 2 * p;
  const double factor = 1 / (1 + retardation_rate * h), slope = 4.0 / 3.0 * hamaker * p * p * p * r / (s * s * d * d);
  if (retardation_rate == 0) return slope;
  return factor * (slope + hamaker / 6 * bracket(p, s, d) * retardation_rate * factor);
}

double surface_energy_of(double hamaker) {
  return hamaker / (24 * std::numbers::pi * contact_distance * contact_distance);
}

}  // namespace crumble
