#include "common/rigid/elastic_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "common/rigid/network.hpp"

namespace crumble {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Displacement and rotation of the sphere -> displacement of the contact point, rotation.
Matrix6 carried(const Vector3& arm) {
  Matrix6 m = Matrix6::Identity();
  m.block<3, 3>(0, 3) << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  return m;
}

Matrix6 joint_stiffness(const ElasticJoint& e, double unit) {
  const Eigen::Matrix3d along = e.normal * e.normal.transpose(), across = Eigen::Matrix3d::Identity() - along;
  Matrix6 D = Matrix6::Zero();
  D.topLeftCorner<3, 3>() = (e.joint.normal * along + e.joint.sliding * across) / unit;
  D.bottomRightCorner<3, 3>() = (e.joint.twisting * along + e.joint.bending * across) / unit;
  return D;
}

bool is_free(const Joint& joint) {
  return !(joint.normal > 0 && joint.sliding > 0 && joint.twisting > 0 && joint.bending > 0);
}

}  // namespace

ElasticBlocks::ElasticBlocks(ElasticInput input) : input_(std::move(input)) {
  number_unknowns();
  if (unknowns_ == 0) return;
  double unit = 0;
  for (const ElasticJoint& e : input_.joints) unit = std::max(unit, e.joint.normal);
  for (const ElasticJoint& e : input_.joints) local_.push_back(joint_stiffness(e, unit));
  const Sparse stiffness = assemble();
  if (std::any_of(input_.joints.begin(), input_.joints.end(), [](const auto& e) { return is_free(e.joint); }))
    refuse_mechanisms(stiffness);
  factor_ = std::make_unique<SparseCholesky>();
  factor_->compute(stiffness);
  if (factor_->info() != Eigen::Success)
    throw std::runtime_error("the stiffness matrix of the contacts is singular to round-off: stiffnesses too unequal?");
}

void ElasticBlocks::number_unknowns() {
  const std::size_t n = input_.block.size();
  std::vector<bool> elastic(n, false), met(static_cast<std::size_t>(input_.blocks), false);
  for (const ElasticJoint& e : input_.joints) elastic[e.joint.i] = elastic[e.joint.j] = true;
  free_.assign(n, -1);
  held_.assign(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    if (!elastic[i]) continue;
    if (!met[input_.block[i]]) {
      met[input_.block[i]] = held_[i] = true;
      continue;
    }
    free_[i] = unknowns_;
    unknowns_ += 6;
  }
}

ElasticBlocks::Sparse ElasticBlocks::assemble() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(78 * input_.joints.size());
  const auto add = [&](int row, int column, const Matrix6& block) {
    if (row < 0 || column < 0) return;
    for (int c = 0; c < 6; ++c)
      for (int r = 0; r < 6; ++r)
        if (row + r >= column + c) entries.emplace_back(row + r, column + c, block(r, c));
  };
  for (std::size_t k = 0; k < input_.joints.size(); ++k) {
    const ElasticJoint& e = input_.joints[k];
    const Matrix6 C_i = carried(e.arm_i), C_j = carried(e.arm_j);
    const int i = free_[e.joint.i], j = free_[e.joint.j];
    add(i, i, C_i.transpose() * local_[k] * C_i);
    add(j, j, C_j.transpose() * local_[k] * C_j);
    if (j > i)
      add(j, i, -C_j.transpose() * local_[k] * C_i);
    else
      add(i, j, -C_i.transpose() * local_[k] * C_j);
  }
  Sparse lower(unknowns_, unknowns_);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

// Load on j at the contact point for given displacements (six rows for each unknown particle).
Eigen::MatrixXd ElasticBlocks::joint_loads(const Eigen::MatrixXd& displacement, std::size_t k) const {
  const ElasticJoint& e = input_.joints[k];
  Eigen::MatrixXd relative = Eigen::MatrixXd::Zero(6, displacement.cols());
  if (const int j = free_[e.joint.j]; j >= 0) relative += carried(e.arm_j) * displacement.middleRows(j, 6);
  if (const int i = free_[e.joint.i]; i >= 0) relative -= carried(e.arm_i) * displacement.middleRows(i, 6);
  return -local_[k] * relative;
}

void ElasticBlocks::add_loads(Eigen::MatrixXd& load, Eigen::MatrixXd& bonds) const {
  if (unknowns_ == 0) return;
  // Refinement on the bond loads: they are a sum of elastic answers, so compatible, and their balance is what the
  // residual measures. It converges while (condition number) x (round-off) < 1.
  constexpr int most_rounds = 6;
  double before = load.cwiseAbs().maxCoeff();
  Eigen::MatrixXd rest(unknowns_, load.cols());
  for (int round = 0; round < most_rounds; ++round) {
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (free_[i] >= 0) rest.middleRows(free_[i], 6) = load.middleRows(6 * static_cast<Eigen::Index>(i), 6);
    const Eigen::MatrixXd displacement = factor_->solve(rest);
    Eigen::MatrixXd then = load, more = bonds;
    for (std::size_t k = 0; k < input_.joints.size(); ++k) {
      const ElasticJoint& e = input_.joints[k];
      const Eigen::MatrixXd on_j = joint_loads(displacement, k);
      more.middleRows(6 * e.row, 6) += on_j;
      then.middleRows(6 * e.joint.j, 6) += carried(e.arm_j).transpose() * on_j;
      then.middleRows(6 * e.joint.i, 6) -= carried(e.arm_i).transpose() * on_j;
    }
    double after = 0;
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (free_[i] >= 0)
        after = std::max(after, then.middleRows(6 * static_cast<Eigen::Index>(i), 6).cwiseAbs().maxCoeff());
    if (!(after < before)) {
      if (!std::isfinite(after)) throw std::runtime_error("the loads of the contacts are not finite");
      return;
    }
    load = std::move(then);
    bonds = std::move(more);
    if (after > 0.1 * before) return;
    before = after;
  }
}

// The softest mode by inverse iteration on a matrix that is shifted just enough to be regular.
void ElasticBlocks::refuse_mechanisms(const Sparse& stiffness) const {
  constexpr double shift = 1e-9, rigid = 1e-11;
  const Eigen::VectorXd diagonal = stiffness.diagonal().cwiseMax(shift);
  Sparse shifted = stiffness;
  for (Eigen::Index k = 0; k < unknowns_; ++k) shifted.coeffRef(k, k) += shift * diagonal[k];
  SparseCholesky factor;
  factor.compute(shifted);
  Eigen::VectorXd u(unknowns_);
  for (Eigen::Index k = 0; k < unknowns_; ++k) u[k] = std::sin(1.0 + 2.399963 * static_cast<double>(k));
  double quotient = 1;
  for (int round = 0; round < 12; ++round) {
    u = factor.solve(diagonal.cwiseProduct(u));
    u /= std::sqrt(u.dot(diagonal.cwiseProduct(u)));
    quotient = u.dot(stiffness.selfadjointView<Eigen::Lower>() * u);
    if (quotient < rigid) break;
  }
  if (quotient >= rigid) return;

  // What moves most freely: relative motion of free joints in the directions without stiffness.
  struct Moving {
    double amount;
    std::string text;
  };
  std::vector<Moving> moving;
  for (const ElasticJoint& e : input_.joints) {
    Eigen::Matrix<double, 6, 1> relative = Eigen::Matrix<double, 6, 1>::Zero();
    if (const int j = free_[e.joint.j]; j >= 0) relative += carried(e.arm_j) * u.segment<6>(j);
    if (const int i = free_[e.joint.i]; i >= 0) relative -= carried(e.arm_i) * u.segment<6>(i);
    const Vector3 shift_ = relative.head<3>(), turn = relative.tail<3>();
    const double along = std::abs(shift_.dot(e.normal)), twist = std::abs(turn.dot(e.normal));
    const std::string pair = std::to_string(e.joint.i) + "-" + std::to_string(e.joint.j);
    const auto add = [&](double stiffness_, double amount, const char* way) {
      if (!(stiffness_ > 0)) moving.push_back({amount, way + (" " + pair)});
    };
    add(e.joint.normal, along, "stretching of");
    add(e.joint.sliding, (shift_ - e.normal.dot(shift_) * e.normal).norm(), "sliding of");
    add(e.joint.twisting, twist, "twisting of");
    add(e.joint.bending, (turn - e.normal.dot(turn) * e.normal).norm(), "bending of");
  }
  std::sort(moving.begin(), moving.end(), [](const Moving& p, const Moving& q) { return p.amount > q.amount; });
  std::string text = "the contacts form a mechanism; what moves without resistance, most of all: ";
  for (std::size_t k = 0; k < std::min<std::size_t>(5, moving.size()); ++k) text += (k ? ", " : "") + moving[k].text;
  throw Mechanism(text);
}

}  // namespace crumble
