// The kinds of flow and of hydrodynamics that scenes name, by the names that they have there.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <string_view>
#include <vector>

#include "common/hydro/linear_flow.hpp"
#include "common/hydro/model.hpp"

namespace crumble {

enum class FlowKind { elongation, shear, uniaxial, biaxial, quiescent };

// Velocity gradient du_i/dx_j at unit shear rate sqrt(2 E:E) = 1/s; zero for quiescent.
//   elongation: planar, du_x/dx = -du_z/dz = 1/2   (paper, 3.3)
//   shear:      du_x/dy = 1                        (paper, 3.4)
//   uniaxial:   stretched along x
//   biaxial:    stretched along x and y
Eigen::Matrix3d unit_gradient(FlowKind kind);

const std::vector<std::string>& flow_names();  // in the order of the enum
FlowKind flow_named(std::string_view name);    // throws std::invalid_argument
const std::string& name_of(FlowKind kind);

// "fts", "fts-lubrication", "fts-relative-lubrication", "multipole".
Rung rung_named(std::string_view name);  // throws std::invalid_argument
const std::string& name_of(Rung rung);

}  // namespace crumble
