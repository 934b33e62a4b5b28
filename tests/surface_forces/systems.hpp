// Pairs of spheres in water at 25 C, for the tests.
#pragma once

#include "common/surface_forces/pair_forces.hpp"
#include "common/surface_forces/stability.hpp"

namespace crumble::systems {

inline constexpr double kT = 1.380649e-23 * 298.15;

inline Electrolyte water(double ionic_strength) { return {ionic_strength, 78.4 * vacuum_permittivity, kT}; }

inline SurfaceForces forces(double hamaker, double potential, double ionic_strength) {
  SurfaceForces f;
  f.hamaker = hamaker;
  f.surface_potential = potential;
  f.electrolyte = water(ionic_strength);
  f.solubility = 5400;
  return f;
}

// Two equal spheres by the plain laws, attraction without end at contact.
struct Plain {
  VanDerWaals attraction;
  DoubleLayer repulsion;

  Plain(const SurfaceForces& f, double a) : attraction{f.hamaker, a, a, retardation_rate(f.retardation_wavelength)} {
    const double Y = effective_potential(f, f.electrolyte, a);
    repulsion = double_layer(f.electrolyte, a, a, Y, Y);
  }
  double energy(double h) const { return attraction.energy(h) + repulsion.energy(h); }
  double tension(double h) const { return attraction.tension(h) + repulsion.tension(h); }
  double in_kT(double h) const { return energy(h) / kT; }
};

}  // namespace crumble::systems
