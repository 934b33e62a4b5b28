// Cholesky factor, inverse and products of large dense matrices, float or double.
//
// By OpenBLAS or by Eigen, whichever common/numerics/blas.hpp takes on this machine; tests ask for either. Both run
// on one thread: threads are shared out here, by tiles, so that results do not depend on their number.
#pragma once

#include <Eigen/Dense>

#include "common/numerics/blas.hpp"

namespace crumble::dense {

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Scalar>
using Block = Eigen::Ref<Matrix<Scalar>, 0, Eigen::OuterStride<>>;
template <class Scalar>
using ConstBlock = Eigen::Ref<const Matrix<Scalar>, 0, Eigen::OuterStride<>>;

using blas::Kernels;

// In-place Cholesky factor in the lower triangle; the upper one is left undefined. Returns 0, or the order of the first
// leading minor that is not positive definite. Works by tiles from order `threads_pay_from` on (60 ms of one core:
// where other programs hold the cores, waiting for a thread costs more than it gains below), on several OpenMP threads
// outside of parallel regions.
template <class Scalar>
int cholesky(Block<Scalar> a, Kernels by = blas::kernels());
inline constexpr int threads_pay_from = 2000;

// How many threads a problem of order n deserves here: 1 below threads_pay_from and inside parallel regions.
int threads_for(Eigen::Index n);

// B <- L^-1 B and L^-T B with the lower triangle L of a.
template <class Scalar>
void solve(const ConstBlock<Scalar>& a, Block<Scalar> b, Kernels by = blas::kernels());
template <class Scalar>
void solve_transposed(const ConstBlock<Scalar>& a, Block<Scalar> b, Kernels by = blas::kernels());

// C <- C + sign A B, or C + sign A^T B.
template <class Scalar>
void multiply_add(Block<Scalar> c, Scalar sign, const ConstBlock<Scalar>& a, const ConstBlock<Scalar>& b,
                  Kernels by = blas::kernels());
template <class Scalar>
void multiply_add_transposed(Block<Scalar> c, Scalar sign, const ConstBlock<Scalar>& a, const ConstBlock<Scalar>& b,
                             Kernels by = blas::kernels());

// (L L^T)^-1, both triangles, in place of the lower triangle L, at a third of the cost of solving for the columns of
// the identity.
template <class Scalar>
void invert_from_factor(Block<Scalar> a, Kernels by = blas::kernels());

}  // namespace crumble::dense
