#include "common/hydro/constrained_factor.hpp"

#include <fmt/format.h>

namespace crumble {

namespace {

template <class Scalar>
lapack::Matrix<Scalar> converted(Eigen::MatrixXd&& matrix) {
  if constexpr (std::is_same_v<Scalar, double>)
    return std::move(matrix);
  else
    return matrix.cast<Scalar>();
}

}  // namespace

template <class Scalar>
ConstrainedFactor<Scalar>::ConstrainedFactor(MobilityMatrix mobility, const Eigen::SparseMatrix<double>& near_field)
    : interior_(mobility.interior()),
      motion_(mobility.motion()),
      has_near_field_(near_field.nonZeros() > 0),
      lower_(converted<Scalar>(std::move(mobility.lower))) {
  const lapack::Threads threads(order());
  if (const int minor = lapack::cholesky(order(), lower_.data(), order()); minor != 0)
    throw NotPositiveDefinite(
        fmt::format("the mobility matrix of {} spheres is not positive definite (leading minor {} of {}): "
                    "overlapping or coincident spheres?",
                    mobility.spheres, minor, order()));
  if (!has_near_field_) return;
  near_field_ = near_field.cast<Scalar>();
  Matrix factor = Matrix::Zero(motion_, motion_);
  factor.template triangularView<Eigen::Lower>() =
      lower_.bottomRightCorner(motion_, motion_).template triangularView<Eigen::Lower>();
  near_.noalias() = near_field_ * factor;
  lapack::multiply_lower(true, motion_, motion_, c(), order(), near_.data(), motion_);
  near_.diagonal().array() += Scalar(1);
  if (const int minor = lapack::cholesky(motion_, near_.data(), motion_); minor != 0)
    throw NotPositiveDefinite(fmt::format(
        "the near-field resistance is not positive semi-definite (leading minor {} of {})", minor, motion_));
}

template <class Scalar>
void ConstrainedFactor<Scalar>::solve_resistance(Matrix& x) const {
  const lapack::Threads threads(static_cast<int>(x.cols()) == 1 ? 1 : order());
  const int columns = static_cast<int>(x.cols());
  lapack::solve_lower(false, order(), columns, a(), order(), x.data(), order());
  lapack::solve_lower(true, order(), columns, a(), order(), x.data(), order());
}

// With y = A^-1 w and t = C^-1 B y: velocities u = C v, (I + C^T D C) v = t + C^T b; then C^T f = v - t and
// A^T f_interior = y - B^T f.
template <class Scalar>
void ConstrainedFactor<Scalar>::solve_mobility(Matrix& x, Matrix& velocity) const {
  const lapack::Threads threads(static_cast<int>(x.cols()) == 1 ? 1 : order());
  const int columns = static_cast<int>(x.cols()), n = order();
  lapack::solve_lower(false, interior_, columns, a(), n, x.data(), n);
  Matrix t = Matrix::Zero(motion_, columns);
  lapack::multiply_add(false, motion_, columns, interior_, Scalar(1), b(), n, x.data(), n, t.data(), motion_);
  lapack::solve_lower(false, motion_, columns, c(), n, t.data(), motion_);
  Matrix v = x.bottomRows(motion_);
  lapack::multiply_lower(true, motion_, columns, c(), n, v.data(), motion_);
  if (has_near_field_) {
    v += t;
    lapack::solve_lower(false, motion_, columns, near_.data(), motion_, v.data(), motion_);
    lapack::solve_lower(true, motion_, columns, near_.data(), motion_, v.data(), motion_);
    Matrix force = v - t;
    lapack::solve_lower(true, motion_, columns, c(), n, force.data(), motion_);
    x.bottomRows(motion_) = force;
  } else {
    v += t;
  }
  lapack::multiply_lower(false, motion_, columns, c(), n, v.data(), motion_);
  velocity = v;
  lapack::multiply_add(true, interior_, columns, motion_, Scalar(-1), b(), n, x.data() + interior_, n, x.data(), n);
  lapack::solve_lower(true, interior_, columns, a(), n, x.data(), n);
}

template class ConstrainedFactor<float>;
template class ConstrainedFactor<double>;

}  // namespace crumble
