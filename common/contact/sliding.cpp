#include "common/contact/sliding.hpp"

#include <cmath>
#include <numbers>

namespace crumble {

using std::numbers::pi;

double sliding_stiffness(const Material& material, double a) {
  const double nu = material.poisson_ratio, E = material.youngs_modulus;
  const double softness = std::cbrt(a * E / (1 + nu));
  return 3.3 * std::cbrt(pi * material.surface_energy * (1 - nu)) / (2 - nu) * softness * softness;
}

double sliding_limit(const Material& material, double b0) {
  const double G = material.youngs_modulus / (2 * (1 + material.poisson_ratio));
  return 0.05 * pi * G * b0 * b0;
}

}  // namespace crumble
