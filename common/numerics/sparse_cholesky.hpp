// Sparse Cholesky factor: CHOLMOD, supernodal, ordered by METIS (nested dissection), on one thread.
#pragma once

#include <Eigen/CholmodSupport>

#include "common/numerics/blas.hpp"

namespace crumble {

// Of the lower triangle of a symmetric positive definite matrix. Its dense blocks go through the BLAS, which is kept on
// one thread so that results do not depend on their number.
class SparseCholesky : private Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> {
  using Base = Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

 public:
  using Matrix = Eigen::SparseMatrix<double>;

  SparseCholesky() {
    // The first method alone: CHOLMOD would otherwise try others.
    cholmod().nmethods = 1;
    cholmod().method[0].ordering = CHOLMOD_METIS;
    cholmod().postorder = 1;
    cholmod().print = 0;
  }

  using Base::analyzePattern;
  using Base::info;
  using Base::setShift;

  void compute(const Matrix& matrix) {
    analyzePattern(matrix);
    factorize(matrix);
  }
  void factorize(const Matrix& matrix) {
    const blas::OneThread guard;
    Base::factorize(matrix);
  }
  template <class Right>
  typename Right::PlainObject solve(const Eigen::MatrixBase<Right>& b) const {
    const blas::OneThread guard;
    return Base::solve(b);
  }
};

}  // namespace crumble
