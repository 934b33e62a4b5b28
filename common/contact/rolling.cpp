#include "common/contact/rolling.hpp"

#include <numbers>

namespace crumble {

double rolling_stiffness(const Material& material, double a) {
  return 3 * std::numbers::pi * material.surface_energy * a * a;
}

double rolling_limit(const Material& material, double a, double b0) {
  return rolling_stiffness(material, a) * 0.2 * b0 / a;
}

}  // namespace crumble
