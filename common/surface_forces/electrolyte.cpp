#include "common/surface_forces/electrolyte.hpp"

#include <cmath>

namespace crumble {

double Electrolyte::inverse_debye_length() const {
  return std::sqrt(2 * avogadro_constant * ionic_strength * elementary_charge * elementary_charge /
                   (permittivity * thermal_energy));
}

double concentrated(double ionic_strength, double volume_before, double volume, double solubility) {
  const double salt = ionic_strength * volume_before;
  return salt < solubility * volume ? salt / volume : solubility;
}

}  // namespace crumble
