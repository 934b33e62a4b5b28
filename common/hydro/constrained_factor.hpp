// Cholesky factor of a mobility matrix that answers both questions a rigid sphere can ask.
//
// The matrix is ordered [interior | motion] (far_field.hpp). Its factor
//   M = L L^T,  L = [ A 0 ; C B  C ]
// (B is kept multiplied by C^-1) holds the mobility of force-and-torque-loaded rigid spheres, C C^T, and the resistance
// problem alike. With a near-field resistance D added to the motion block (R = M^-1 + D, lubrication), velocities
// follow from the second, smaller factor of  I + C^T D C, which is at least the identity where D is positive
// semi-definite: the sum is never ill-conditioned by a nearly touching pair, and no inverse is formed.
#pragma once

#include <Eigen/Sparse>
#include <stdexcept>

#include "common/hydro/dense_kernels.hpp"
#include "common/hydro/far_field.hpp"

namespace crumble {

struct NotPositiveDefinite : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Scalar float halves time and memory: good as a preconditioner for a refinement in double.
template <class Scalar_>
class ConstrainedFactor {
 public:
  using Scalar = Scalar_;
  using Matrix = dense::Matrix<Scalar>;

  // `near_field` is D, 6N x 6N, both triangles; one without entries means none. Throws NotPositiveDefinite.
  ConstrainedFactor(MobilityMatrix mobility, const Eigen::SparseMatrix<double>& near_field);

  int interior() const { return interior_; }
  int motion() const { return motion_; }

  // x <- M^-1 x, all right-hand sides (columns) at once; rows [interior | motion].
  void solve_resistance(Matrix& x) const;

  // On entry the rows of x hold what is known: w of the interior, and the loads b on the motion that are left to far
  // field and D together. On return: the far-field loads f of both, and the velocities u (6N rows) unless null. Solves
  //   M f = (w, u),  f_motion + D u = b.
  void solve_mobility(Matrix& x, Matrix* velocity) const;

 private:
  int interior_ = 0, motion_ = 0;
  bool has_near_field_ = false;
  Matrix lower_;  // A, B, C
  Matrix near_;   // factor of I + C^T D C

  auto a() const { return lower_.topLeftCorner(interior_, interior_); }
  auto b() const { return lower_.bottomLeftCorner(motion_, interior_); }
  auto c() const { return lower_.bottomRightCorner(motion_, motion_); }
};

extern template class ConstrainedFactor<float>;
extern template class ConstrainedFactor<double>;

}  // namespace crumble
