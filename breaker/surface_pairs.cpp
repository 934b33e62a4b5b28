#include "breaker/surface_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace crumble::breaker {

namespace {
// By how much two surfaces may come nearer before pairs are looked for again, and what is listed in advance for that;
// in the smallest radius.
constexpr double complete = 0.2, skin = 0.5;
double smallest(const std::vector<double>& radius) { return *std::min_element(radius.begin(), radius.end()); }
}  // namespace

SurfacePairs::SurfacePairs(const SurfaceForces& forces, const BondLaws& contacts, const std::vector<double>& radius)
    : radius_(radius),
      laws_(forces, contacts, radius),
      list_(laws_.range() + skin * smallest(radius), laws_.range() + complete * smallest(radius)) {}

void SurfacePairs::update(const Frame& frame) {
  list_.update(frame.position, radius_, {});
  pairs_.clear();
  auto bond = frame.contacts.begin();
  for (const Pair& pair : list_.pairs()) {
    while (bond != frame.contacts.end() && Pair{bond->i, bond->j} < pair) ++bond;
    const double reach = radius_[pair.i] + radius_[pair.j] + laws_.range() + complete * smallest(radius_);
    if ((frame.position[pair.j] - frame.position[pair.i]).squaredNorm() < reach * reach)
      pairs_.push_back({pair.i, pair.j, bond != frame.contacts.end() && Pair{bond->i, bond->j} == pair});
  }
}

SurfacePairs::Apart SurfacePairs::apart(const Frame& frame, const Near& pair, const Eigen::VectorXd* q) const {
  Vector3 D = frame.position[pair.j] - frame.position[pair.i];
  if (q) D += q->segment<3>(6 * pair.j) - q->segment<3>(6 * pair.i);
  const double distance = D.norm();
  return {D / distance, distance, distance - radius_[pair.i] - radius_[pair.j]};
}

double SurfacePairs::tension(const Near& pair, double gap) const {
  const PairForces law = laws_(pair.i, pair.j);
  return pair.bonded ? law.bonded_tension(gap) : law.open_tension(gap);
}

void SurfacePairs::add_loads(const Frame& frame, Eigen::VectorXd& loads) const {
  for (const Near& pair : pairs_) {
    const Apart now = apart(frame, pair, nullptr);
    const Vector3 pull = tension(pair, now.gap) * now.normal;
    loads.segment<3>(6 * pair.i) += pull;
    loads.segment<3>(6 * pair.j) -= pull;
  }
}

double SurfacePairs::energy(const Frame& frame, const Eigen::VectorXd& q) const {
  double sum = 0;
  for (const Near& pair : pairs_) {
    const PairForces law = laws_(pair.i, pair.j);
    const double gap = apart(frame, pair, &q).gap;
    sum += pair.bonded ? law.bonded_energy(gap) : law.open_energy(gap);
  }
  return sum;
}

void SurfacePairs::add_gradient(const Frame& frame, const Eigen::VectorXd& q, Eigen::VectorXd& gradient) const {
  for (const Near& pair : pairs_) {
    const Apart then = apart(frame, pair, &q);
    const Vector3 pull = tension(pair, then.gap) * then.normal;
    gradient.segment<3>(6 * pair.i) -= pull;
    gradient.segment<3>(6 * pair.j) += pull;
  }
}

void SurfacePairs::add_stiffness(const Frame& frame, const Eigen::VectorXd& q, Curvature curvature,
                                 Eigen::MatrixXd& matrix) const {
  for (const Near& pair : pairs_) {
    const Apart then = apart(frame, pair, &q);
    if (then.gap > laws_.range()) continue;
    // By a difference that is small against every length of the law.
    const double width = 1e-4 * std::max(std::abs(then.gap), laws_(pair.i, pair.j).attraction.joined_gap());
    double along = (tension(pair, then.gap + 0.5 * width) - tension(pair, then.gap - 0.5 * width)) / width;
    double across = tension(pair, then.gap) / then.distance;
    if (curvature == Curvature::convex) along = std::max(along, 0.0), across = std::max(across, 0.0);
    const Eigen::Matrix3d nn = then.normal * then.normal.transpose();
    const Eigen::Matrix3d K = along * nn + across * (Eigen::Matrix3d::Identity() - nn);
    matrix.block<3, 3>(6 * pair.i, 6 * pair.i) += K;
    matrix.block<3, 3>(6 * pair.j, 6 * pair.j) += K;
    matrix.block<3, 3>(6 * pair.j, 6 * pair.i) -= K;  // i < j: the lower triangle
  }
}

}  // namespace crumble::breaker
