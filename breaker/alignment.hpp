// How long the agglomerate takes to turn into the flow.
#pragma once

#include <optional>

#include "common/hydro/turning_body.hpp"

namespace crumble::breaker {

// Strain gamma_dot t after which a rigid body that starts as it stands stays within `angle` (rad) of the orientation
// where it comes to rest; nothing if it has not within `longest` (shear: it tumbles for ever).
// turning: rotation per unit strain; gradient: of the flow at unit shear rate.
std::optional<double> alignment_strain(const Eigen::Matrix<double, 3, 5>& turning, const Eigen::Matrix3d& gradient,
                                       double angle = 0.02, double longest = 2000);

}  // namespace crumble::breaker
