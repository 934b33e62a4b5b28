// What either library does for one matrix or tile on one thread: the parts of dense_kernels. L is a lower triangle.
#pragma once

#include "common/hydro/dense_kernels.hpp"

namespace crumble::dense {

template <class Scalar>
struct EigenKernels {
  using Out = Block<Scalar>;
  using In = const ConstBlock<Scalar>&;
  static int cholesky(Out a);
  static void solve(In l, Out b);             // B <- L^-1 B
  static void solve_transposed(In l, Out b);  // B <- L^-T B
  static void solve_right(In l, Out b);       // B <- B L^-T
  static void multiply_add(Out c, Scalar sign, In a, In b);
  static void multiply_add_transposed(Out c, Scalar sign, In a, In b);  // A^T B
  static void subtract_outer(Out c, In a, In b);                        // C <- C - A B^T
  static void subtract_square(Out c, In a);                             // lower triangle of C - A A^T
  static void invert_from_factor(Out a);                                // lower triangle of (L L^T)^-1
};

template <class Scalar>
struct OpenBlasKernels {
  using Out = Block<Scalar>;
  using In = const ConstBlock<Scalar>&;
  static int cholesky(Out a);
  static void solve(In l, Out b);
  static void solve_transposed(In l, Out b);
  static void solve_right(In l, Out b);
  static void multiply_add(Out c, Scalar sign, In a, In b);
  static void multiply_add_transposed(Out c, Scalar sign, In a, In b);
  static void subtract_outer(Out c, In a, In b);
  static void subtract_square(Out c, In a);
  static void invert_from_factor(Out a);
};

}  // namespace crumble::dense
