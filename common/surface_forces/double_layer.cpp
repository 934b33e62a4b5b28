#include "common/surface_forces/double_layer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace crumble {

double effective_potential(const Electrolyte& electrolyte, double a, double potential) {
  const double g = std::tanh(potential / (4 * electrolyte.thermal_voltage()));
  const double x = electrolyte.inverse_debye_length() * a;
  return 8 * g / (1 + std::sqrt(1 - (2 * x + 1) * g * g / ((x + 1) * (x + 1))));
}

double DoubleLayer::plain_energy(double gap) const { return strength / (distance + gap) * std::exp(-kappa * gap); }

double DoubleLayer::energy(double gap) const {
  return gap < 0 ? plain_energy(0) + tension(0) * gap : plain_energy(gap);
}

double DoubleLayer::tension(double gap) const {
  const double h = std::max(gap, 0.0);
  return -plain_energy(h) * (kappa + 1 / (distance + h));
}

double DoubleLayer::stiffness(double gap) const {
  const double per_r = 1 / (distance + gap), rate = kappa + per_r;
  return plain_energy(gap) * (rate * rate + per_r * per_r);
}

DoubleLayer double_layer(const Electrolyte& electrolyte, double a1, double a2, double effective_1, double effective_2) {
  const double volt = electrolyte.thermal_voltage();
  return {4 * std::numbers::pi * electrolyte.permittivity * volt * volt * effective_1 * effective_2 * a1 * a2, a1 + a2,
          electrolyte.inverse_debye_length()};
}

double critical_coagulation_concentration(const Electrolyte& electrolyte, double potential, double hamaker) {
  const double volt = electrolyte.thermal_voltage(), g = std::tanh(potential / (4 * volt));
  const double kappa =
      384 * std::numbers::pi * electrolyte.permittivity * volt * volt * g * g / (std::numbers::e * hamaker);
  Electrolyte unit = electrolyte;
  unit.ionic_strength = 1;
  const double of_unit = unit.inverse_debye_length();
  return kappa * kappa / (of_unit * of_unit);
}

}  // namespace crumble
