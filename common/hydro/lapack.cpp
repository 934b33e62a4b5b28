#include "common/hydro/lapack.hpp"

#include <cblas.h>
#include <omp.h>

extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void spotrf_(const char* uplo, const int* n, float* a, const int* lda, int* info);
// OpenBLAS only; with another BLAS these are null and its own setting rules.
void openblas_set_num_threads(int) __attribute__((weak));
int openblas_get_num_threads() __attribute__((weak));
}

namespace crumble::lapack {

namespace {
CBLAS_TRANSPOSE mode(bool transpose) { return transpose ? CblasTrans : CblasNoTrans; }
}  // namespace

int cholesky(int n, double* a, int leading) {
  int info = 0;
  dpotrf_("L", &n, a, &leading, &info);
  return info;
}
int cholesky(int n, float* a, int leading) {
  int info = 0;
  spotrf_("L", &n, a, &leading, &info);
  return info;
}

void solve_lower(bool transpose, int n, int columns, const double* a, int leading, double* b, int leading_b) {
  if (columns == 1)
    cblas_dtrsv(CblasColMajor, CblasLower, mode(transpose), CblasNonUnit, n, a, leading, b, 1);
  else
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, mode(transpose), CblasNonUnit, n, columns, 1, a, leading, b,
                leading_b);
}
void solve_lower(bool transpose, int n, int columns, const float* a, int leading, float* b, int leading_b) {
  if (columns == 1)
    cblas_strsv(CblasColMajor, CblasLower, mode(transpose), CblasNonUnit, n, a, leading, b, 1);
  else
    cblas_strsm(CblasColMajor, CblasLeft, CblasLower, mode(transpose), CblasNonUnit, n, columns, 1, a, leading, b,
                leading_b);
}

void multiply_lower(bool transpose, int n, int columns, const double* a, int leading, double* b, int leading_b) {
  if (columns == 1)
    cblas_dtrmv(CblasColMajor, CblasLower, mode(transpose), CblasNonUnit, n, a, leading, b, 1);
  else
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, mode(transpose), CblasNonUnit, n, columns, 1, a, leading, b,
                leading_b);
}
void multiply_lower(bool transpose, int n, int columns, const float* a, int leading, float* b, int leading_b) {
  if (columns == 1)
    cblas_strmv(CblasColMajor, CblasLower, mode(transpose), CblasNonUnit, n, a, leading, b, 1);
  else
    cblas_strmm(CblasColMajor, CblasLeft, CblasLower, mode(transpose), CblasNonUnit, n, columns, 1, a, leading, b,
                leading_b);
}

void multiply_add(bool transpose, int rows, int columns, int inner, double sign, const double* a, int leading,
                  const double* b, int leading_b, double* c, int leading_c) {
  if (columns == 1)
    cblas_dgemv(CblasColMajor, mode(transpose), transpose ? inner : rows, transpose ? rows : inner, sign, a, leading, b,
                1, 1, c, 1);
  else
    cblas_dgemm(CblasColMajor, mode(transpose), CblasNoTrans, rows, columns, inner, sign, a, leading, b, leading_b, 1,
                c, leading_c);
}
void multiply_add(bool transpose, int rows, int columns, int inner, float sign, const float* a, int leading,
                  const float* b, int leading_b, float* c, int leading_c) {
  if (columns == 1)
    cblas_sgemv(CblasColMajor, mode(transpose), transpose ? inner : rows, transpose ? rows : inner, sign, a, leading, b,
                1, 1, c, 1);
  else
    cblas_sgemm(CblasColMajor, mode(transpose), CblasNoTrans, rows, columns, inner, sign, a, leading, b, leading_b, 1,
                c, leading_c);
}

void multiply_symmetric(int n, int columns, const double* a, int leading, const double* b, int leading_b, double* c,
                        int leading_c) {
  if (columns == 1)
    cblas_dsymv(CblasColMajor, CblasLower, n, 1, a, leading, b, 1, 0, c, 1);
  else
    cblas_dsymm(CblasColMajor, CblasLeft, CblasLower, n, columns, 1, a, leading, b, leading_b, 0, c, leading_c);
}

Threads::Threads(int n) {
  if (openblas_set_num_threads == nullptr || openblas_get_num_threads == nullptr) return;
  before_ = openblas_get_num_threads();
  const int wanted = n < threads_pay_from || omp_in_parallel() ? 1 : omp_get_max_threads();
  if (wanted == before_)
    before_ = 0;
  else
    openblas_set_num_threads(wanted);
}

Threads::~Threads() {
  if (before_ != 0) openblas_set_num_threads(before_);
}

}  // namespace crumble::lapack
