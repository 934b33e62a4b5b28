// The physics that a scene asks for.
#pragma once

#include "common/contact/bond_law.hpp"
#include "dryer/droplet.hpp"

namespace crumble {

struct DryingModel {
  Droplet droplet;
  double viscosity = 1e-3;    // mu, Pa s
  double thermal_energy = 0;  // kT, J; 0: no Brownian motion, D = 0
  Material material;
  ContactChoice contact;
};

}  // namespace crumble
