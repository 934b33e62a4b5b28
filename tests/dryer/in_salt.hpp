// Pairs of charged spheres far from the surface of a droplet.
#pragma once

#include "common/surface_forces/surface_forces.hpp"
#include "dryer/drag.hpp"
#include "tests/dryer/samples.hpp"

namespace crumble::dryer::samples {

inline constexpr double a = 10e-9, kT = boltzmann_constant * 298.15;

inline SurfaceForces forces(double hamaker, double potential, double ionic_strength) {
  SurfaceForces f;
  f.hamaker = hamaker;
  f.surface_potential = potential;
  f.electrolyte = {ionic_strength, 78.4 * vacuum_permittivity, kT};
  f.solubility = 5400;
  return f;
}

// No surface anywhere near.
inline DryingModel in_bulk(const SurfaceForces& f) {
  DryingModel model;
  model.droplet = {1e-3, 1e6, 0};
  model.thermal_energy = kT;
  model.surface_forces = f;
  return model;
}

}  // namespace crumble::dryer::samples
