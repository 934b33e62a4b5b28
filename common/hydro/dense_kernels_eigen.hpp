// The definitions of EigenKernels, for the two files that instantiate them: one file would take the compiler twice as
// long.
#pragma once

#include "common/hydro/dense_tiles.hpp"

namespace crumble::dense {

namespace tiles {

constexpr Eigen::Index smallest_block = 64;

// L <- L^-1, halves at a time: [A 0; B C]^-1 = [A^-1 0; -C^-1 B A^-1  C^-1]. The upper triangle is not touched.
template <class Scalar>
void invert(Block<Scalar> L) {
  const Eigen::Index n = L.rows();
  if (n <= smallest_block) {
    Matrix<Scalar> inverse = Matrix<Scalar>::Identity(n, n);
    L.template triangularView<Eigen::Lower>().solveInPlace(inverse);
    L.template triangularView<Eigen::Lower>() = inverse;
    return;
  }
  const Eigen::Index h = n / 2, k = n - h;
  invert<Scalar>(L.topLeftCorner(h, h));
  invert<Scalar>(L.bottomRightCorner(k, k));
  const Matrix<Scalar> right = L.bottomLeftCorner(k, h) * L.topLeftCorner(h, h).template triangularView<Eigen::Lower>();
  L.bottomLeftCorner(k, h).noalias() = -(L.bottomRightCorner(k, k).template triangularView<Eigen::Lower>() * right);
}

// The lower triangle of L^T L in place of L: [A^T A + B^T B  .; C^T B  C^T C].
template <class Scalar>
void square(Block<Scalar> L) {
  const Eigen::Index n = L.rows();
  if (n <= smallest_block) {
    const Matrix<Scalar> lower = L.template triangularView<Eigen::Lower>();
    L.template triangularView<Eigen::Lower>() = lower.transpose() * lower;
    return;
  }
  const Eigen::Index h = n / 2, k = n - h;
  square<Scalar>(L.topLeftCorner(h, h));
  L.topLeftCorner(h, h).template selfadjointView<Eigen::Lower>().rankUpdate(L.bottomLeftCorner(k, h).transpose());
  L.bottomLeftCorner(k, h) =
      (L.bottomRightCorner(k, k).template triangularView<Eigen::Lower>().transpose() * L.bottomLeftCorner(k, h)).eval();
  square<Scalar>(L.bottomRightCorner(k, k));
}

}  // namespace tiles

template <class Scalar>
int EigenKernels<Scalar>::cholesky(Out a) {
  return static_cast<int>(Eigen::internal::llt_inplace<Scalar, Eigen::Lower>::blocked(a) + 1);
}

// Eigen takes its kernels for vectors only where it knows at compile time that a matrix has one column.
template <class Scalar>
void EigenKernels<Scalar>::solve(In l, Out b) {
  if (b.cols() == 1) {
    auto column = b.col(0);
    l.template triangularView<Eigen::Lower>().solveInPlace(column);
  } else {
    l.template triangularView<Eigen::Lower>().solveInPlace(b);
  }
}

template <class Scalar>
void EigenKernels<Scalar>::solve_transposed(In l, Out b) {
  if (b.cols() == 1) {
    auto column = b.col(0);
    l.template triangularView<Eigen::Lower>().transpose().solveInPlace(column);
  } else {
    l.template triangularView<Eigen::Lower>().transpose().solveInPlace(b);
  }
}

template <class Scalar>
void EigenKernels<Scalar>::solve_right(In l, Out b) {
  l.template triangularView<Eigen::Lower>().transpose().template solveInPlace<Eigen::OnTheRight>(b);
}

template <class Scalar>
void EigenKernels<Scalar>::multiply_add(Out c, Scalar sign, In a, In b) {
  if (b.cols() == 1)
    c.col(0).noalias() += sign * (a * b.col(0));
  else
    c.noalias() += sign * (a * b);
}

template <class Scalar>
void EigenKernels<Scalar>::multiply_add_transposed(Out c, Scalar sign, In a, In b) {
  if (b.cols() == 1)
    c.col(0).noalias() += sign * (a.transpose() * b.col(0));
  else
    c.noalias() += sign * (a.transpose() * b);
}

template <class Scalar>
void EigenKernels<Scalar>::subtract_outer(Out c, In a, In b) {
  c.noalias() -= a * b.transpose();
}

template <class Scalar>
void EigenKernels<Scalar>::subtract_square(Out c, In a) {
  c.template selfadjointView<Eigen::Lower>().rankUpdate(a, Scalar(-1));
}

template <class Scalar>
void EigenKernels<Scalar>::invert_from_factor(Out a) {
  tiles::invert<Scalar>(a);
  tiles::square<Scalar>(a);
}

}  // namespace crumble::dense
