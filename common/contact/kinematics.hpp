// Relative motion of two bonded spheres, and the rotation of what a bond remembers.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace crumble {

struct RelativeMotion {
  Eigen::Vector3d sliding;  // of the surface of j past that of i at the contact, m (or m/s)
  Eigen::Vector3d rolling;  // (I - nn)(W_j - W_i), rad (or rad/s)
  double twisting;          // n.(W_j - W_i), rad (or rad/s)
};

// u_s = (I - nn)(v_j - v_i) - (l_i W_i + l_j W_j) x n with n from i to j. The lever arms l_i, l_j divide the distance
// of centres, so that sliding forces at the contact point leave no net torque on the pair. Linear: velocities give
// rates, displacements give increments. Source: Marshall 2009; rolling measure of Bagi & Kuhn 2004.
//   u_r = -a (W_i - W_j) x n, here as the relative angle (I - nn)(W_j - W_i)              (paper, Eq. 18)
inline RelativeMotion relative_motion(const Eigen::Vector3d& n, const Eigen::Vector3d& v_ij, const Eigen::Vector3d& W_i,
                                      const Eigen::Vector3d& W_j, double l_i, double l_j) {
  const Eigen::Vector3d W_ij = W_j - W_i;
  const double twist = n.dot(W_ij);
  const Eigen::Vector3d arm = l_i * W_i + l_j * W_j;
  return {v_ij - n.dot(v_ij) * n - arm.cross(n), W_ij - twist * n, twist};
}

// The rotation that carries the contact frame along: first the smallest one that takes the old normal to the new, then
// the mean spin of the two spheres about it. Exact for rigid rotation of the pair about any axis up to third order in
// the angle of one step. spin_angle: n.(dW_i + dW_j)/2 of the step, rad.
class FrameRotation {
 public:
  FrameRotation(const Eigen::Vector3d& n_old, const Eigen::Vector3d& n_new, double spin_angle)
      : n_(n_new),
        axis_(n_old.cross(n_new)),
        k_(1 / (1 + n_old.dot(n_new))),
        sin_(std::sin(spin_angle)),
        cos_(std::cos(spin_angle)) {}

  // The result is exactly perpendicular to the new normal and keeps the length of the perpendicular part.
  void apply(Eigen::Vector3d& history) const {
    // Rodrigues' formula with sin = |axis_| and (1 - cos)/sin^2 = 1/(1 + cos).
    Eigen::Vector3d v = history + axis_.cross(history) + k_ * axis_.cross(axis_.cross(history));
    v -= n_.dot(v) * n_;
    history = cos_ * v + sin_ * n_.cross(v);
  }

 private:
  Eigen::Vector3d n_, axis_;
  double k_, sin_, cos_;
};

}  // namespace crumble
