// Undisturbed flow that is linear in space: u(x) = velocity + gradient x.
#pragma once

#include "common/agglomerate/agglomerate.hpp"
#include "common/hydro/strain_basis.hpp"

namespace crumble {

// SI units: velocity m/s, at the origin; gradient(i, j) = du_i/dx_j, 1/s, traceless.
struct LinearFlow {
  Vector3 velocity = Vector3::Zero();
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();

  Vector3 velocity_at(const Vector3& x) const { return velocity + gradient * x; }
  Vector3 angular_velocity() const {
    return 0.5 *
           Vector3(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0), gradient(1, 0) - gradient(0, 1));
  }
  Vector5 strain() const { return strain_components(gradient); }
};

// Planar elongation du_x/dx = -du_z/dz = rate/2, so that rate = sqrt(2 E:E) as in simple shear (paper, section 3.3).
inline LinearFlow planar_elongation(double rate) {
  LinearFlow flow;
  flow.gradient.diagonal() = Vector3(rate / 2, 0, -rate / 2);
  return flow;
}

// Simple shear u_x = rate y (paper, section 3.4).
inline LinearFlow simple_shear(double rate) {
  LinearFlow flow;
  flow.gradient(0, 1) = rate;
  return flow;
}

}  // namespace crumble
