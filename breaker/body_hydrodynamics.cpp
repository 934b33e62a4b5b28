#include "breaker/body_hydrodynamics.hpp"

#include <stdexcept>

#include "common/hydro/dense_kernels.hpp"

namespace crumble::breaker {

using Eigen::MatrixXd;

BodyHydrodynamics::BodyHydrodynamics(const std::vector<double>& radius, double viscosity, const HydroModel& model,
                                     Precision precision)
    : length_(mean_radius(Spheres{{}, radius})), viscosity_(viscosity), model_(model), precision_(precision) {
  if (model.rung == Rung::multipole)
    throw std::invalid_argument("a deforming agglomerate needs a far-field rung, not multipoles");
  for (double a : radius) reduced_.radius.push_back(a / length_);
}

void BodyHydrodynamics::place(const std::vector<Vector3>& position) {
  Vector3 centre = Vector3::Zero();
  for (const Vector3& x : position) centre += x / static_cast<double>(position.size());
  reduced_.position.clear();
  for (const Vector3& x : position) reduced_.position.push_back((x - centre) / length_);
  check(reduced_);
}

void BodyHydrodynamics::renew_far_field(const std::vector<Vector3>& position) {
  place(position);
  assemble_far_field(reduced_, mobility_);
  if (precision_ == Precision::float32)
    invert_far_field<float>();
  else
    invert_far_field<double>();
  renew_lubrication(position);
}

// With M = L L^T, L = [A 0; B C] in the order [strain | motion]: loads of motions (C C^T)^-1 w, and loads of the
// strain -e on spheres at rest -(C C^T)^-1 B A^-1 (-e).
template <class Scalar>
void BodyHydrodynamics::invert_far_field() {
  const int strains = mobility_.interior(), motions = mobility_.motion();
  dense::Matrix<Scalar> lower = mobility_.lower.cast<Scalar>();
  if (dense::cholesky<Scalar>(lower) != 0)
    throw std::runtime_error("the far-field mobility is not positive definite: do spheres overlap?");
  auto resistance = lower.bottomRightCorner(motions, motions);
  dense::invert_from_factor<Scalar>(resistance);
  far_resistance_ = resistance.template cast<double>();
  dense::Matrix<Scalar> strain = -Eigen::Matrix<Scalar, 5, 5>::Identity().replicate(reduced_.size(), 1);
  dense::solve<Scalar>(lower.topLeftCorner(strains, strains), strain);
  const dense::Matrix<Scalar> motion = -lower.bottomLeftCorner(motions, strains) * strain;
  far_strain_.noalias() = far_resistance_ * motion.template cast<double>();
}

void BodyHydrodynamics::renew_lubrication(const std::vector<Vector3>& position) {
  place(position);
  const int n = reduced_.size();
  const Lubrication near = lubrication(reduced_, model_);
  MatrixXd resistance = far_resistance_;
  const Eigen::SparseMatrix<double> D = near.motion_resistance(n);
  for (int column = 0; column < D.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(D, column); it; ++it)
      resistance(it.row(), it.col()) += it.value();

  // Loads exerted on the fluid by the six rigid motions and, held in the ambient flow, by the five strains.
  MatrixXd motion = MatrixXd::Zero(6 * n, 11), strain = MatrixXd::Zero(5 * n, 11);
  for (int i = 0; i < n; ++i) {
    const Vector3& x = reduced_.position[i];
    motion.block<6, 6>(6 * i, 0).setIdentity();
    motion.block<3, 3>(6 * i, 3) << 0, x.z(), -x.y(), -x.z(), 0, x.x(), x.y(), -x.x(), 0;
    motion.block<3, 5>(6 * i, 6) = -strain_along(x);
    strain.block<5, 5>(5 * i, 6) = -Eigen::Matrix<double, 5, 5>::Identity();
  }
  const MatrixXd rigid = motion.leftCols<6>();
  MatrixXd loads = far_resistance_ * motion, stresslet = MatrixXd::Zero(5 * n, 11);
  loads.rightCols<5>() += far_strain_;
  near.add(motion, strain, loads, stresslet);
  const Eigen::Matrix<double, 6, 6> drag = rigid.transpose() * loads.leftCols<6>();
  const Eigen::Matrix<double, 6, 5> drift = -drag.llt().solve(rigid.transpose() * loads.rightCols<5>());
  free_loads_ = -viscosity_ * length_ * length_ * (loads.rightCols<5>() + loads.leftCols<6>() * drift);
  turning_ = drift.bottomRows<3>();
  resistance_ = viscosity_ * length_ * resistance;
}

}  // namespace crumble::breaker
