// The physics that a scene asks for.
#pragma once

#include <optional>

#include "common/contact/bond_law.hpp"
#include "common/hydro/model.hpp"
#include "common/surface_forces/surface_forces.hpp"

namespace crumble::breaker {

struct BreakupModel {
  Material material;
  ContactChoice contact;
  double viscosity = 1;  // mu, Pa s
  HydroModel hydro{Rung::fts_relative_lubrication};
  double weak_stress = 2;  // Pa; a flow below it is too weak to matter: no step is shorter for it
  // Of the flow at unit shear rate sqrt(2 E:E); zero: at rest. Along a history, of the flow in which strength is said.
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  std::optional<SurfaceForces> surface_forces;
};

}  // namespace crumble::breaker
