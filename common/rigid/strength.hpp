// At which flow stress an agglomerate would break if it did not deform.
#pragma once

#include <Eigen/Dense>

#include "common/agglomerate/agglomerate.hpp"
#include "common/contact/material.hpp"
#include "common/hydro/model.hpp"
#include "common/rigid/joint.hpp"

namespace crumble {

// The flow stress mu gamma_dot, Pa, at which the first contact of a free rigid agglomerate reaches its pull-off force,
// in the orientation that loads it most. One piece with closed contacts; gradient: of unit shear rate. Where no contact
// is ever in tension, that of a doublet in Stokes drag, F_po/(6 pi a^2), stands in.
double rigid_strength(const Agglomerate& agglomerate, const Material& material, const JointChoice& joint,
                      const HydroModel& hydro, const Eigen::Matrix3d& gradient);

}  // namespace crumble
