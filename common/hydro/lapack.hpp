// The few BLAS and LAPACK calls that the hydrodynamic operators need, for float and double, on column-major storage.
#pragma once

#include <Eigen/Dense>

namespace crumble::lapack {

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

// In-place Cholesky factor in the lower triangle. Returns 0, or the order of the first leading minor that is not
// positive definite.
int cholesky(int n, double* a, int leading);
int cholesky(int n, float* a, int leading);

// B <- L^-1 B (or L^-T B) with the lower triangle L of a.
void solve_lower(bool transpose, int n, int columns, const double* a, int leading, double* b, int leading_b);
void solve_lower(bool transpose, int n, int columns, const float* a, int leading, float* b, int leading_b);

// B <- L B (or L^T B).
void multiply_lower(bool transpose, int n, int columns, const double* a, int leading, double* b, int leading_b);
void multiply_lower(bool transpose, int n, int columns, const float* a, int leading, float* b, int leading_b);

// C <- C + sign A B (or A^T B), A being rows x inner after the transposition.
void multiply_add(bool transpose, int rows, int columns, int inner, double sign, const double* a, int leading,
                  const double* b, int leading_b, double* c, int leading_c);
void multiply_add(bool transpose, int rows, int columns, int inner, float sign, const float* a, int leading,
                  const float* b, int leading_b, float* c, int leading_c);

// C <- A B with the symmetric matrix whose lower triangle is in a.
void multiply_symmetric(int n, int columns, const double* a, int leading, const double* b, int leading_b, double* c,
                        int leading_c);

// While it lives, BLAS works with as many threads as a problem of order n deserves: one below `threads_pay_from`
// (waking a second thread costs more than it gains there) and inside OpenMP regions, omp_get_max_threads() above.
class Threads {
 public:
  explicit Threads(int n);
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  int before_ = 0;
};
inline constexpr int threads_pay_from = 600;

}  // namespace crumble::lapack
