#include "breaker/body_hydrodynamics.hpp"

#include <stdexcept>

#include "breaker/triangular.hpp"

namespace crumble {

using Eigen::MatrixXd;

BodyHydrodynamics::BodyHydrodynamics(const std::vector<double>& radius, double viscosity, const HydroModel& model)
    : length_(mean_radius(Spheres{{}, radius})), viscosity_(viscosity), model_(model) {
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

// With M = L L^T, L = [A 0; B C] in the order [strain | motion]: loads of motions (C C^T)^-1 w, and loads of the
// strain -e on spheres at rest -(C C^T)^-1 B A^-1 (-e).
void BodyHydrodynamics::renew_far_field(const std::vector<Vector3>& position) {
  place(position);
  ++renewals_;
  assemble_far_field(reduced_, mobility_);
  const int strains = mobility_.interior(), motions = mobility_.motion();
  const Eigen::LLT<Eigen::Ref<MatrixXd>> factor(mobility_.lower);
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("the far-field mobility is not positive definite: do spheres overlap?");
  far_resistance_ = inverse_from_factor(mobility_.lower.bottomRightCorner(motions, motions));
  MatrixXd strain = -Eigen::Matrix<double, 5, 5>::Identity().replicate(reduced_.size(), 1);
  mobility_.lower.topLeftCorner(strains, strains).triangularView<Eigen::Lower>().solveInPlace(strain);
  const MatrixXd motion = -mobility_.lower.bottomLeftCorner(motions, strains) * strain;
  far_strain_ = far_resistance_ * motion;
  renew_lubrication(position);
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

}  // namespace crumble
