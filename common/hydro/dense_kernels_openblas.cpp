#include <cblas.h>
#include <f77blas.h>

#include "common/hydro/dense_tiles.hpp"

namespace crumble::dense {

namespace {

char lower[] = "L";

// The two precisions under one name; an overload each, as BLAS has them.
struct Names {
  static void gemm(CBLAS_TRANSPOSE ta, CBLAS_TRANSPOSE tb, int m, int n, int k, double alpha, const double* a, int lda,
                   const double* b, int ldb, double* c, int ldc) {
    cblas_dgemm(CblasColMajor, ta, tb, m, n, k, alpha, a, lda, b, ldb, 1.0, c, ldc);
  }
  static void gemm(CBLAS_TRANSPOSE ta, CBLAS_TRANSPOSE tb, int m, int n, int k, float alpha, const float* a, int lda,
                   const float* b, int ldb, float* c, int ldc) {
    cblas_sgemm(CblasColMajor, ta, tb, m, n, k, alpha, a, lda, b, ldb, 1.0f, c, ldc);
  }
  static void syrk(int n, int k, double alpha, const double* a, int lda, double* c, int ldc) {
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n, k, alpha, a, lda, 1.0, c, ldc);
  }
  static void syrk(int n, int k, float alpha, const float* a, int lda, float* c, int ldc) {
    cblas_ssyrk(CblasColMajor, CblasLower, CblasNoTrans, n, k, alpha, a, lda, 1.0f, c, ldc);
  }
  static void trsm(CBLAS_SIDE side, CBLAS_TRANSPOSE t, int m, int n, const double* a, int lda, double* b, int ldb) {
    cblas_dtrsm(CblasColMajor, side, CblasLower, t, CblasNonUnit, m, n, 1.0, a, lda, b, ldb);
  }
  static void trsm(CBLAS_SIDE side, CBLAS_TRANSPOSE t, int m, int n, const float* a, int lda, float* b, int ldb) {
    cblas_strsm(CblasColMajor, side, CblasLower, t, CblasNonUnit, m, n, 1.0f, a, lda, b, ldb);
  }
  static int potrf(int n, double* a, int lda) {
    int info = 0;
    dpotrf_(lower, &n, a, &lda, &info);
    return info;
  }
  static int potrf(int n, float* a, int lda) {
    int info = 0;
    spotrf_(lower, &n, a, &lda, &info);
    return info;
  }
  static void potri(int n, double* a, int lda) {
    int info = 0;
    dpotri_(lower, &n, a, &lda, &info);
  }
  static void potri(int n, float* a, int lda) {
    int info = 0;
    spotri_(lower, &n, a, &lda, &info);
  }
};

template <class Matrix>
int rows(const Matrix& m) {
  return static_cast<int>(m.rows());
}
template <class Matrix>
int columns(const Matrix& m) {
  return static_cast<int>(m.cols());
}
template <class Matrix>
int stride(const Matrix& m) {
  return static_cast<int>(std::max<Eigen::Index>(1, m.outerStride()));
}

}  // namespace

template <class Scalar>
int OpenBlasKernels<Scalar>::cholesky(Out a) {
  const blas::OneThread guard;
  return Names::potrf(rows(a), a.data(), stride(a));
}

template <class Scalar>
void OpenBlasKernels<Scalar>::solve(In l, Out b) {
  const blas::OneThread guard;
  Names::trsm(CblasLeft, CblasNoTrans, rows(b), columns(b), l.data(), stride(l), b.data(), stride(b));
}

template <class Scalar>
void OpenBlasKernels<Scalar>::solve_transposed(In l, Out b) {
  const blas::OneThread guard;
  Names::trsm(CblasLeft, CblasTrans, rows(b), columns(b), l.data(), stride(l), b.data(), stride(b));
}

template <class Scalar>
void OpenBlasKernels<Scalar>::solve_right(In l, Out b) {
  const blas::OneThread guard;
  Names::trsm(CblasRight, CblasTrans, rows(b), columns(b), l.data(), stride(l), b.data(), stride(b));
}

template <class Scalar>
void OpenBlasKernels<Scalar>::multiply_add(Out c, Scalar sign, In a, In b) {
  const blas::OneThread guard;
  Names::gemm(CblasNoTrans, CblasNoTrans, rows(c), columns(c), columns(a), sign, a.data(), stride(a), b.data(),
              stride(b), c.data(), stride(c));
}

template <class Scalar>
void OpenBlasKernels<Scalar>::multiply_add_transposed(Out c, Scalar sign, In a, In b) {
  const blas::OneThread guard;
  Names::gemm(CblasTrans, CblasNoTrans, rows(c), columns(c), rows(a), sign, a.data(), stride(a), b.data(), stride(b),
              c.data(), stride(c));
}

template <class Scalar>
void OpenBlasKernels<Scalar>::subtract_outer(Out c, In a, In b) {
  const blas::OneThread guard;
  Names::gemm(CblasNoTrans, CblasTrans, rows(c), columns(c), columns(a), Scalar(-1), a.data(), stride(a), b.data(),
              stride(b), c.data(), stride(c));
}

template <class Scalar>
void OpenBlasKernels<Scalar>::subtract_square(Out c, In a) {
  const blas::OneThread guard;
  Names::syrk(rows(c), columns(a), Scalar(-1), a.data(), stride(a), c.data(), stride(c));
}

template <class Scalar>
void OpenBlasKernels<Scalar>::invert_from_factor(Out a) {
  const blas::OneThread guard;
  Names::potri(rows(a), a.data(), stride(a));
}

template struct OpenBlasKernels<float>;
template struct OpenBlasKernels<double>;

}  // namespace crumble::dense
