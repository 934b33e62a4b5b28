// What a scene says of the forces between surfaces in the liquid.
#pragma once

#include <optional>

#include "common/surface_forces/electrolyte.hpp"

namespace crumble {

struct SurfaceForces {
  double hamaker = 0;                 // A across the liquid, J
  double retardation_wavelength = 0;  // lambda, m; 0: not retarded
  // The surfaces keep either their potential (V) or their charge (C/m^2) while the salt is concentrated.
  double surface_potential = 0;
  std::optional<double> surface_charge;
  Electrolyte electrolyte;      // as it is at the start
  double solubility = 0;        // of the salt, mol/m^3
  std::optional<double> range;  // gap beyond which two particles do not feel each other, m; else automatic_range
};

// Without a range of its own: beyond it neither energy of a pair of the largest particles exceeds this, kT.
inline constexpr double negligible_energy = 0.01;

}  // namespace crumble
