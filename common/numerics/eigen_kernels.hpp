// The kernels of Eigen under every product and solve of dense matrices: instantiated once, in eigen_kernels.cpp,
// because each takes the compiler seconds. Where this header is not read a file compiles its own, which are the same.
#pragma once

#include <Eigen/Dense>

// These are the insides of Eigen 3.4.
#if EIGEN_WORLD_VERSION == 3 && EIGEN_MAJOR_VERSION == 4

namespace crumble::eigen {

template <class S>
using Traits = Eigen::internal::gebp_traits<S, S>;
template <class S>
using Packing = typename Traits<S>::LhsPacket4Packing;
template <class S>
using Output = Eigen::internal::blas_data_mapper<S, Eigen::Index, Eigen::ColMajor, Eigen::Unaligned, 1>;
template <class S, int order>
using Input = Eigen::internal::const_blas_data_mapper<S, Eigen::Index, order>;

}  // namespace crumble::eigen

// For S = double and float; `declare` is `extern template struct` here, `template struct` in eigen_kernels.cpp.
#define CRUMBLE_EIGEN_KERNELS(declare, S)                                                                              \
  declare Eigen::internal::gebp_kernel<S, S, Eigen::Index, crumble::eigen::Output<S>, crumble::eigen::Traits<S>::mr,   \
                                       crumble::eigen::Traits<S>::nr, false, false>;                                   \
  declare Eigen::internal::gemm_pack_lhs<S, Eigen::Index, crumble::eigen::Input<S, 0>, crumble::eigen::Traits<S>::mr,  \
                                         crumble::eigen::Traits<S>::LhsProgress, crumble::eigen::Packing<S>, 0>;       \
  declare Eigen::internal::gemm_pack_lhs<S, Eigen::Index, crumble::eigen::Input<S, 1>, crumble::eigen::Traits<S>::mr,  \
                                         crumble::eigen::Traits<S>::LhsProgress, crumble::eigen::Packing<S>, 1>;       \
  declare Eigen::internal::gemm_pack_lhs<S, Eigen::Index, crumble::eigen::Output<S>, crumble::eigen::Traits<S>::mr,    \
                                         crumble::eigen::Traits<S>::LhsProgress, crumble::eigen::Packing<S>, 0, false, \
                                         true>;                                                                        \
  declare                                                                                                              \
      Eigen::internal::gemm_pack_rhs<S, Eigen::Index, crumble::eigen::Input<S, 0>, crumble::eigen::Traits<S>::nr, 0>;  \
  declare                                                                                                              \
      Eigen::internal::gemm_pack_rhs<S, Eigen::Index, crumble::eigen::Input<S, 1>, crumble::eigen::Traits<S>::nr, 1>;  \
  declare Eigen::internal::gemm_pack_rhs<S, Eigen::Index, crumble::eigen::Output<S>, crumble::eigen::Traits<S>::nr, 0, \
                                         false, true>;                                                                 \
  declare Eigen::internal::general_matrix_vector_product<Eigen::Index, S, crumble::eigen::Input<S, 0>, 0, false, S,    \
                                                         crumble::eigen::Input<S, 0>, false>;                          \
  declare Eigen::internal::general_matrix_vector_product<Eigen::Index, S, crumble::eigen::Input<S, 0>, 0, false, S,    \
                                                         crumble::eigen::Input<S, 1>, false>;                          \
  declare Eigen::internal::general_matrix_vector_product<Eigen::Index, S, crumble::eigen::Input<S, 1>, 1, false, S,    \
                                                         crumble::eigen::Input<S, 0>, false>;                          \
  declare Eigen::internal::triangular_solve_matrix<S, Eigen::Index, Eigen::OnTheLeft, Eigen::Lower, false, 0, 0, 1>;   \
  declare Eigen::internal::triangular_solve_matrix<S, Eigen::Index, Eigen::OnTheLeft, Eigen::Upper, false, 1, 0, 1>;   \
  declare Eigen::internal::triangular_solve_matrix<S, Eigen::Index, Eigen::OnTheRight, Eigen::Upper, false, 1, 0, 1>;  \
  declare Eigen::internal::tribb_kernel<S, S, Eigen::Index, crumble::eigen::Traits<S>::mr,                             \
                                        crumble::eigen::Traits<S>::nr, false, false, 1, Eigen::Lower>;

CRUMBLE_EIGEN_KERNELS(extern template struct, double)
CRUMBLE_EIGEN_KERNELS(extern template struct, float)
extern template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;

#endif
