#include "common/surface_forces/surface_charge.hpp"

#include <cmath>

namespace crumble {

namespace {

// sigma e/(2 eps kappa kT).
double reduced_charge(double y, double kappa_a) {
  if (std::abs(y) < 1e-4) return 0.5 * y * (1 + 1 / kappa_a);
  const double s = std::sinh(y / 2), c = std::cosh(y / 4);
  return s * std::sqrt(1 + 2 / (kappa_a * c * c) + 8 * std::log(c) / (kappa_a * kappa_a * s * s));
}

}  // namespace

double surface_charge(const Electrolyte& electrolyte, double a, double potential) {
  const double kappa = electrolyte.inverse_debye_length(), volt = electrolyte.thermal_voltage();
  return 2 * electrolyte.permittivity * kappa * volt * reduced_charge(potential / volt, kappa * a);
}

// Grows with y.
double surface_potential(const Electrolyte& electrolyte, double a, double charge) {
  const double kappa = electrolyte.inverse_debye_length(), volt = electrolyte.thermal_voltage();
  const double wanted = std::abs(charge) / (2 * electrolyte.permittivity * kappa * volt);
  double low = 0, high = 2 * wanted / (1 + 1 / (kappa * a));
  while (reduced_charge(high, kappa * a) < wanted) high *= 2;
  for (int k = 0; k < 200 && high - low > 1e-15 * high; ++k) {
    const double y = 0.5 * (low + high);
    (reduced_charge(y, kappa * a) < wanted ? low : high) = y;
  }
  return std::copysign(0.5 * (low + high) * volt, charge);
}

}  // namespace crumble
