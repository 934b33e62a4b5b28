#include "common/contact/jkr.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace crumble {

using std::numbers::pi;

double pull_off_force(const Material& material, double pair_radius) {
  return 1.5 * pi * material.surface_energy * pair_radius;
}

namespace {
const double c_pull_off = std::cbrt(0.5);
}

Jkr::Jkr(const Material& material, double a) : pull_off_force(crumble::pull_off_force(material, a)) {
  const double nu = material.poisson_ratio;
  const double compliance = material.surface_energy * (1 - nu * nu) / material.youngs_modulus;
  zero_load_radius = std::cbrt(4.5 * pi * compliance * a * a);
  length = zero_load_radius * zero_load_radius / a;
  equilibrium_gap = -2.0 / 3.0 * length;
  pull_off_gap = std::cbrt(0.375 * pi * pi * compliance * compliance * a);
}

// Solves 6 c^4 - 4 c + 3 gap/length = 0 for its larger root by Newton's method. The polynomial is convex there and the
// start, the tangent of c(gap) at zero force, lies never below the root, so the iterates fall to it monotonically.
double Jkr::root(double gap) const {
  const double eta = gap / length;
  double c = 1 - 0.15 * (eta + 2.0 / 3.0);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double c3 = c * c * c;
    const double step = (6 * c3 * c - 4 * c + 3 * eta) / (24 * c3 - 4);
    c -= step;
    if (!(std::abs(step) > 1e-15 * c)) break;
  }
  return c;
}

Jkr::State Jkr::state(double gap) const {
  if (gap >= pull_off_gap) return {pull_off_force, 0};
  const double c = root(gap);
  const double c3 = c * c * c;
  // dN/dc = 12 F_po c^2 (1 - 2 c^3) and dh/dc = (4/3) length (1 - 6 c^3).
  const double stiffness = 9 * pull_off_force / length * c * c * (2 * c3 - 1) / (6 * c3 - 1);
  return {4 * pull_off_force * c3 * (1 - c3), stiffness > 0 ? stiffness : 0};
}

double Jkr::gap(double tension) const {
  if (tension > pull_off_force) throw std::domain_error("tension beyond the pull-off force");
  const double s = std::sqrt(1 - tension / pull_off_force);
  return length * std::cbrt((1 + s) / 2) * (1 - 3 * s) / 3;
}

double Jkr::energy(double gap) const {
  const double c = gap >= pull_off_gap ? c_pull_off : root(gap);
  const double c4 = c * c * c * c, c7 = c4 * c * c * c;
  // Integral of N dh in c: (16/3) F_po length (c^4/4 - c^7 + (3/5) c^10), which is -0.15 at equilibrium (c = 1).
  return 16.0 / 3.0 * pull_off_force * length * (0.25 * c4 - c7 + 0.6 * c7 * c * c * c + 0.15);
}

}  // namespace crumble
