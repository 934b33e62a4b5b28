#include "common/contact/twisting.hpp"

#include <numbers>

namespace crumble {

using std::numbers::pi;

double twisting_stiffness(const Material& material, double a) {
  return 6 * pi * material.surface_energy * a * a * (1 - material.poisson_ratio);
}

double twisting_limit(const Material& material, double a) { return 0.0125 * pi * twisting_stiffness(material, a); }

}  // namespace crumble
