// The physics that a scene asks for.
#pragma once

#include <optional>

#include "common/contact/bond_law.hpp"
#include "common/surface_forces/surface_forces.hpp"
#include "dryer/capillary.hpp"
#include "dryer/droplet.hpp"

namespace crumble::dryer {

// What holds for a particle that the liquid has left behind (r > R + a).
struct DryParticles {
  bool everything_acts = false;  // thermal noise goes on as if the liquid were there
  double drag_factor = 1;        // of Stokes drag, which stays as a relaxation
};

struct DryingModel {
  Droplet droplet;
  double crust_diffusivity = 1;  // of vapour in the dry crust, relative to that in the gas; 1: no hindrance
  double viscosity = 1e-3;       // mu, Pa s
  double thermal_energy = 0;     // kT, J; 0: no Brownian motion, D = 0
  Material material;
  ContactChoice contact;
  DryParticles dry;
  std::optional<SurfaceForces> surface_forces;
};

}  // namespace crumble::dryer
