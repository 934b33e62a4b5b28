// What pair lubrication adds to the far field, as sparse blocks (made in lubrication.hpp, empty for methods without).
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace crumble {

// Added resistance D in reduced units, acting on w = (motion 6N, strain 5N), symmetric.
struct NearFieldResistance {
  Eigen::SparseMatrix<double> motion_motion, motion_strain, strain_strain;

  bool empty() const { return motion_motion.nonZeros() == 0; }
};

// q += D w.
inline void add_near_field(const NearFieldResistance& D, const Eigen::MatrixXd& w_motion,
                           const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& q_motion, Eigen::MatrixXd& q_strain) {
  if (D.empty()) return;
  q_motion += D.motion_motion * w_motion + D.motion_strain * w_strain;
  q_strain += D.motion_strain.transpose() * w_motion + D.strain_strain * w_strain;
}

}  // namespace crumble
