// The physics that a scene asks for.
#pragma once

#include "common/contact/bond_law.hpp"
#include "common/hydro/model.hpp"

namespace crumble {

struct BreakupModel {
  Material material;
  ContactChoice contact;
  double viscosity = 1;  // mu, Pa s
  HydroModel hydro{Rung::fts_relative_lubrication};
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();  // of the flow at unit shear rate sqrt(2 E:E); zero: at rest
};

}  // namespace crumble
