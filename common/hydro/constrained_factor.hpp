// Cholesky factor of a mobility matrix that answers both questions a rigid sphere can ask.
//
// The matrix is ordered [interior | motion] (far_field.hpp). Its factor
//   M = L L^T,  L = [ A 0 ; B C ]
// holds the mobility of force-and-torque-loaded rigid spheres, C C^T, and the resistance problem alike. With a
// near-field resistance D added to the motion block (R = M^-1 + D, lubrication), velocities follow from the second,
// smaller factor of  I + C^T D C, which is at least the identity where D is positive semi-definite: the sum is never
// ill-conditioned by a nearly touching pair, and no inverse is formed.
#pragma once

#include <Eigen/Sparse>
#include <stdexcept>

#include "common/hydro/far_field.hpp"
#include "common/hydro/lapack.hpp"

namespace crumble {

struct NotPositiveDefinite : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Scalar float halves time and memory: good as a preconditioner for a refinement in double.
template <class Scalar>
class ConstrainedFactor {
 public:
  using Matrix = lapack::Matrix<Scalar>;

  // `near_field` is D, 6N x 6N, both triangles; an empty matrix (0 x 0) means none.
  ConstrainedFactor(MobilityMatrix mobility, const Eigen::SparseMatrix<double>& near_field);

  int interior() const { return interior_; }
  int motion() const { return motion_; }

  // x <- M^-1 x, all right-hand sides (columns) at once; rows [interior | motion].
  void solve_resistance(Matrix& x) const;

  // On entry the rows of x hold what is known: w of the interior, and b = q - (D w)_interior-part of the motion, that
  // is, the loads to be carried by far field and by D acting on the unknown velocities. On return: the far-field
  // loads f of both. `velocity` (6N rows) receives u. Solves  M f = (w, u),  f_motion + D u = b.
  void solve_mobility(Matrix& x, Matrix& velocity) const;

 private:
  int interior_ = 0, motion_ = 0;
  bool has_near_field_ = false;
  Matrix lower_;  // A, B, C
  Matrix near_;   // factor of I + C^T D C
  Eigen::SparseMatrix<Scalar> near_field_;

  int order() const { return interior_ + motion_; }
  const Scalar* a() const { return lower_.data(); }
  const Scalar* b() const { return lower_.data() + interior_; }
  const Scalar* c() const { return lower_.data() + static_cast<std::ptrdiff_t>(interior_) * order() + interior_; }
};

extern template class ConstrainedFactor<float>;
extern template class ConstrainedFactor<double>;

}  // namespace crumble
