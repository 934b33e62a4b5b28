#include "common/hydro/constrained_factor.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace crumble {

namespace {

template <class Scalar>
dense::Matrix<Scalar> converted(Eigen::MatrixXd&& matrix) {
  if constexpr (std::is_same_v<Scalar, double>)
    return std::move(matrix);
  else
    return matrix.cast<Scalar>();
}

template <class Triangle, class Scalar>
dense::Matrix<Scalar> product(const Triangle& a, const dense::Matrix<Scalar>& b) {
  dense::Matrix<Scalar> c(b.rows(), b.cols());
  // Eigen takes its kernels for vectors only where it knows at compile time that there is one column.
  if (b.cols() == 1)
    c.col(0).noalias() = a * b.col(0);
  else
    c.noalias() = a * b;
  return c;
}

// Lower triangle of C^T D C. Columns of C^T are rows of C: the sparse product runs along memory.
template <class Scalar>
dense::Matrix<Scalar> congruence(const dense::ConstBlock<Scalar>& c, const Eigen::SparseMatrix<double>& D) {
  constexpr Eigen::Index width = 96;
  const Eigen::Index n = c.rows();
  const dense::Matrix<Scalar> C = c.template triangularView<Eigen::Lower>();
  const dense::Matrix<Scalar> half = dense::Matrix<Scalar>(C.transpose()) * D.template cast<Scalar>();
  dense::Matrix<Scalar> result = dense::Matrix<Scalar>::Zero(n, n);
#pragma omp parallel for schedule(dynamic) num_threads(dense::threads_for(n))
  for (Eigen::Index j = 0; j < n; j += width) {
    const Eigen::Index rest = n - j, columns = std::min(width, rest);
    dense::multiply_add<Scalar>(result.block(j, j, rest, columns), 1, half.bottomRightCorner(rest, rest),
                                C.block(j, j, rest, columns));
  }
  return result;
}

}  // namespace

template <class Scalar>
ConstrainedFactor<Scalar>::ConstrainedFactor(MobilityMatrix mobility, const Eigen::SparseMatrix<double>& near_field)
    : interior_(mobility.interior()),
      motion_(mobility.motion()),
      has_near_field_(near_field.nonZeros() > 0),
      lower_(converted<Scalar>(std::move(mobility.lower))) {
  if (const int minor = dense::cholesky<Scalar>(lower_); minor != 0)
    throw NotPositiveDefinite(
        fmt::format("the mobility matrix of {} spheres is not positive definite (leading minor {} of {}): "
                    "overlapping or coincident spheres?",
                    mobility.spheres, minor, lower_.rows()));
  constexpr int width = 256;
#pragma omp parallel for schedule(dynamic) num_threads(dense::threads_for(lower_.rows()))
  for (int j = 0; j < interior_; j += width)
    dense::solve<Scalar>(c(), lower_.block(interior_, j, motion_, std::min(width, interior_ - j)));
  if (!has_near_field_) return;
  near_ = congruence<Scalar>(c(), near_field);
  near_.diagonal().array() += Scalar(1);
  if (const int minor = dense::cholesky<Scalar>(near_); minor != 0)
    throw NotPositiveDefinite(fmt::format(
        "the near-field resistance is not positive semi-definite (leading minor {} of {})", minor, motion_));
}

template <class Scalar>
void ConstrainedFactor<Scalar>::solve_resistance(Matrix& x) const {
  auto inner = x.topRows(interior_), outer = x.bottomRows(motion_);
  dense::solve<Scalar>(a(), inner);
  dense::solve<Scalar>(c(), outer);
  dense::multiply_add<Scalar>(outer, -1, b(), inner);
  dense::multiply_add_transposed<Scalar>(inner, -1, b(), outer);
  dense::solve_transposed<Scalar>(c(), outer);
  dense::solve_transposed<Scalar>(a(), inner);
}

// With y = A^-1 w, t = B y and g = C^T f: velocities are u = C (g + t). Without D, f = b; with it u = C v,
// (I + C^T D C) v = t + C^T b and g = v - t. Then A^T f_interior = y - B^T g.
template <class Scalar>
void ConstrainedFactor<Scalar>::solve_mobility(Matrix& x, Matrix* velocity) const {
  auto inner = x.topRows(interior_), outer = x.bottomRows(motion_);
  dense::solve<Scalar>(a(), inner);
  Matrix t = Matrix::Zero(motion_, x.cols());
  dense::multiply_add<Scalar>(t, 1, b(), inner);
  const auto C = c().template triangularView<Eigen::Lower>();
  Matrix g = product(C.transpose(), Matrix(outer));
  if (has_near_field_) {
    g += t;
    dense::solve<Scalar>(near_, g);
    dense::solve_transposed<Scalar>(near_, g);
    g -= t;
    outer = g;
    dense::solve_transposed<Scalar>(c(), outer);
  }
  if (velocity != nullptr) *velocity = product(C, Matrix(g + t));
  dense::multiply_add_transposed<Scalar>(inner, -1, b(), g);
  dense::solve_transposed<Scalar>(a(), inner);
}

template class ConstrainedFactor<float>;
template class ConstrainedFactor<double>;

}  // namespace crumble
