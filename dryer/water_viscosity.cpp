#include "dryer/water_viscosity.hpp"

#include <cmath>
#include <stdexcept>

namespace crumble::dryer {

double water_viscosity(double temperature) {
  if (!(temperature >= water_viscosity_from && temperature <= water_viscosity_to))
    throw std::domain_error("viscosity of water: temperature outside 253.15 to 383.15 K");
  const double t = temperature / 300;
  return 1e-6 * (280.68 * std::pow(t, -1.9) + 511.45 * std::pow(t, -7.7) + 61.131 * std::pow(t, -19.6) +
                 0.45903 * std::pow(t, -40.0));
}

}  // namespace crumble::dryer
