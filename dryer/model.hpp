// The physics that a scene asks for.
#pragma once

#include "common/contact/bond_law.hpp"
#include "dryer/droplet.hpp"

namespace crumble {

struct DryingModel {
  Droplet droplet;
  double viscosity = 1e-3;  // mu, Pa s
  Material material;
  ContactChoice contact;
};

}  // namespace crumble
