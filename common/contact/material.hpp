// What the particles are made of (paper, Table 1).
#pragma once

namespace crumble {

struct Material {
  double youngs_modulus = 3.4e9;   // E, Pa
  double poisson_ratio = 0.5;      // nu
  double surface_energy = 4.8e-3;  // gamma_s of one surface, J/m^2 (work of adhesion w = 2 gamma_s)
  double density = 1300;           // kg/m^3
};

// The radius a that the equal-sphere formulas of the paper take for a pair of spheres: 2 R*, R* = a_i a_j/(a_i + a_j).
// All contact laws depend on the radii through R* alone (Johnson, Kendall & Roberts 1971), so this is exact.
constexpr double pair_radius(double radius_i, double radius_j) {
  return 2 * radius_i * radius_j / (radius_i + radius_j);
}

}  // namespace crumble
