// Cholesky factor and triangular products on large dense matrices, float or double.
//
// They run on Eigen's kernels, compiled for the processor that builds, and not on a BLAS that guesses the processor
// when it is loaded: OpenBLAS 0.3.21 (Debian 12) takes those it does not know for SSE3 machines, and one factor of
// order 1265 then takes 46 ms instead of 15 (its own AVX-512 kernel, forced by OPENBLAS_CORETYPE: 19).
#pragma once

#include <Eigen/Dense>

namespace crumble::dense {

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Scalar>
using Block = Eigen::Ref<Matrix<Scalar>, 0, Eigen::OuterStride<>>;
template <class Scalar>
using ConstBlock = Eigen::Ref<const Matrix<Scalar>, 0, Eigen::OuterStride<>>;

// In-place Cholesky factor in the lower triangle; the upper one is left undefined. Returns 0, or the order of the first
// leading minor that is not positive definite. Works by tiles, on several OpenMP threads from order `threads_pay_from`
// on (60 ms of one core: where other programs hold the cores, waiting for a thread costs more than it gains below), on
// one inside parallel regions; results do not depend on their number.
template <class Scalar>
int cholesky(Block<Scalar> a);
inline constexpr int threads_pay_from = 2000;

extern template int cholesky<float>(Block<float>);
extern template int cholesky<double>(Block<double>);

// How many threads a problem of order n deserves here: 1 below threads_pay_from and inside parallel regions.
int threads_for(Eigen::Index n);

// B <- L^-1 B and L^-T B with the lower triangle L of a.
template <class Scalar>
void solve(const ConstBlock<Scalar>& a, Block<Scalar> b);
template <class Scalar>
void solve_transposed(const ConstBlock<Scalar>& a, Block<Scalar> b);

extern template void solve<float>(const ConstBlock<float>&, Block<float>);
extern template void solve<double>(const ConstBlock<double>&, Block<double>);
extern template void solve_transposed<float>(const ConstBlock<float>&, Block<float>);
extern template void solve_transposed<double>(const ConstBlock<double>&, Block<double>);

}  // namespace crumble::dense
