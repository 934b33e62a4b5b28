#include "dryer/water_surface_tension.hpp"

#include <cmath>
#include <stdexcept>

namespace crumble::dryer {

double water_surface_tension(double temperature) {
  if (!(temperature >= water_surface_tension_from && temperature <= water_surface_tension_to))
    throw std::domain_error("surface tension of water: temperature outside 248.15 to 647.096 K");
  const double x = 1 - temperature / water_critical_temperature;
  return 235.8e-3 * std::pow(x, 1.256) * (1 - 0.625 * x);
}

}  // namespace crumble::dryer
