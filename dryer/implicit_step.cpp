#include "dryer/implicit_step.hpp"

#include <algorithm>
#include <cmath>

#include "common/agglomerate/bond.hpp"
#include "common/contact/plastic_spring.hpp"
#include "dryer/drag.hpp"

namespace crumble {

using Matrix3 = Eigen::Matrix3d;

ImplicitStep::ImplicitStep(const DryingModel& model, const Agglomerate& state, const BondLaws& laws)
    : model_(model), state_(state), laws_(laws) {}

void ImplicitStep::set_network(const std::vector<std::int32_t>& active) {
  std::vector<Vector6> kept(active.size(), Vector6::Zero());
  for (std::size_t k = 0; k < active.size(); ++k)
    if (!slot_.empty() && slot_[active[k]] >= 0) kept[k] = increment_[slot_[active[k]]];
  increment_ = std::move(kept);
  active_ = active;
  slot_.assign(state_.particles.size(), -1);
  for (std::size_t k = 0; k < active_.size(); ++k) slot_[active_[k]] = static_cast<std::int32_t>(k);
  std::vector<BlockPair> pairs;
  for (const Contact& bond : state_.state.contacts) pairs.push_back({slot_[bond.i], slot_[bond.j]});
  matrix_.set_pattern(static_cast<std::int32_t>(active_.size()), pairs);
}

Vector3 ImplicitStep::translation(std::int32_t particle) const { return increment_[slot_[particle]].head<3>(); }

Vector3 ImplicitStep::rotation(std::int32_t particle) const {
  return increment_[slot_[particle]].tail<3>() / state_.particles.radius[particle];
}

// What a bond looks like after the increments: trial displacements of its springs before yielding.
struct ImplicitStep::BondState {
  Vector3 separation;
  double distance, gap;
  Vector3 sliding, rolling;
  double twisting;
  double l_i, l_j, a_i, a_j;
};

ImplicitStep::BondState ImplicitStep::bond_state(const Contact& bond, const std::vector<Vector6>& q) const {
  const auto& x = state_.state.position;
  const double a_i = state_.particles.radius[bond.i], a_j = state_.particles.radius[bond.j];
  const Vector6 &q_i = q[slot_[bond.i]], &q_j = q[slot_[bond.j]];
  const Vector3& n = bond.normal;
  const Vector3 dx = q_j.head<3>() - q_i.head<3>();
  const Vector3 W_i = q_i.tail<3>() / a_i, W_j = q_j.tail<3>() / a_j, W = W_j - W_i;
  BondState s;
  s.a_i = a_i;
  s.a_j = a_j;
  s.l_i = lever_arm(bond, a_i, a_j);
  s.l_j = lever_arm(bond, a_j, a_i);
  s.separation = x[bond.j] - x[bond.i] + dx;
  s.distance = s.separation.norm();
  s.gap = s.distance - a_i - a_j;
  s.sliding = bond.sliding + dx - n.dot(dx) * n + n.cross(s.l_i * W_i + s.l_j * W_j);
  const double twist = n.dot(W);
  s.rolling = bond.rolling + W - twist * n;
  s.twisting = bond.twisting + twist;
  return s;
}

double ImplicitStep::surface_energy(std::size_t k, const Vector3& translation) const {
  if (!implicit_surface_[k]) return -held_[k].dot(translation);
  const std::int32_t p = active_[k];
  const double r = (state_.state.position[p] + translation).norm();
  return capillary_energy(model_.droplet.surface_tension, state_.particles.radius[p], r - R_);
}

void ImplicitStep::choose_surface_forces() {
  implicit_surface_.assign(active_.size(), false);
  held_.assign(active_.size(), Vector3::Zero());
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const double a = state_.particles.radius[active_[k]];
    const Vector3 x = state_.state.position[active_[k]] + increment_[k].head<3>();
    const double r = x.norm();
    implicit_surface_[k] = R_ > a && r <= R_;
    if (!implicit_surface_[k] && surface_cuts(a, r, R_))
      held_[k] = -capillary_force(model_.droplet.surface_tension, a, r - R_) / r * x;
  }
}

double ImplicitStep::energy(const std::vector<Vector6>& q) const {
  double total = 0;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const std::int32_t p = active_[k];
    const double a = state_.particles.radius[p];
    const double zeta = drag_coefficient(model_.viscosity, a);
    const double zeta_r = rotational_drag_coefficient(model_.viscosity, a) / (a * a);
    total += (zeta * q[k].head<3>().squaredNorm() + zeta_r * q[k].tail<3>().squaredNorm()) / (2 * dt_);
    total += surface_energy(k, q[k].head<3>());
  }
  for (const Contact& bond : state_.state.contacts) {
    const BondLaw& law = laws_(bond.i, bond.j);
    const BondState s = bond_state(bond, q);
    total += law.normal_energy(s.gap) + capped_energy(s.sliding.norm(), law.k_s, law.sliding_limit(bond.normal_force)) +
             capped_energy(s.rolling.norm(), law.k_r, law.M_r_crit) +
             capped_energy(std::abs(s.twisting), law.k_t, law.M_t_crit);
  }
  return total;
}

void ImplicitStep::linearise_particle(std::size_t k, const Vector6& q) {
  const std::int32_t p = active_[k];
  const double a = state_.particles.radius[p], sigma = model_.droplet.surface_tension;
  const double zeta = drag_coefficient(model_.viscosity, a) / dt_;
  const double zeta_r = rotational_drag_coefficient(model_.viscosity, a) / (a * a * dt_);
  Matrix6 H = Matrix6::Zero();
  H.diagonal() << zeta, zeta, zeta, zeta_r, zeta_r, zeta_r;
  gradient_[k] = H.diagonal().cwiseProduct(q);

  const Vector3 x = state_.state.position[p] + q.head<3>();
  const double r = x.norm(), offset = r - R_;
  const double F_c = implicit_surface_[k] ? capillary_force(sigma, a, offset) : 0;
  if (F_c > 0) {
    const Vector3 e = x / r;
    gradient_[k].head<3>() += F_c * e;
    // F_c rises like the root of the immersion, so near first touch the tangent overshoots; the secant through the
    // origin never does. The tangent takes over once the iterates settle.
    const double depth = offset + a;
    const bool settled = std::abs(depth - depth_[k]) < 0.3 * depth;
    double slope = std::max(capillary_slope(sigma, a, offset), 0.0);
    if (!settled) slope = std::max(slope, F_c / depth);
    depth_[k] = depth;
    H.topLeftCorner<3, 3>() += slope * e * e.transpose() + F_c / r * (Matrix3::Identity() - e * e.transpose());
  } else {
    depth_[k] = 0;
    gradient_[k].head<3>() -= held_[k];
  }
  matrix_.add_diagonal(static_cast<std::int32_t>(k), H);
}

namespace {

// Second derivative of capped_energy(|xi|) in the plane of xi: k P below the limit, (F/|xi|)(P - uu) beyond.
Matrix3 spring_matrix(const Vector3& xi, const Vector3& n, double stiffness, double limit, Vector3& force) {
  const double length = xi.norm();
  const Matrix3 P = Matrix3::Identity() - n * n.transpose();
  if (stiffness * length <= limit) {
    force = stiffness * xi;
    return stiffness * P;
  }
  const Vector3 u = xi / length;
  force = limit * u;
  return limit / length * (P - u * u.transpose());
}

Matrix3 cross_matrix(const Vector3& n) {
  Matrix3 C;
  C << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  return C;
}

}  // namespace

void ImplicitStep::linearise_bond(std::size_t b, const std::vector<Vector6>& q) {
  const Contact& bond = state_.state.contacts[b];
  const BondLaw& law = laws_(bond.i, bond.j);
  const BondState s = bond_state(bond, q);
  const Vector3 &n0 = bond.normal, n = s.separation / s.distance;

  const auto [N, k_n] = law.normal(s.gap);
  Vector3 F_s, M_r;
  const Matrix3 D_s = spring_matrix(s.sliding, n0, law.k_s, law.sliding_limit(bond.normal_force), F_s);
  const Matrix3 D_r = spring_matrix(s.rolling, n0, law.k_r, law.M_r_crit, M_r);
  const bool twisted = law.k_t * std::abs(s.twisting) > law.M_t_crit;
  const double M_t = twisted ? std::copysign(law.M_t_crit, s.twisting) : law.k_t * s.twisting;

  // Relative displacement dx_j - dx_i of the gap, and u = P(dx_j - dx_i) + n0 x (l_i W_i + l_j W_j) of the sliding.
  const bool lost = s.gap > law.lost_gap();
  const double tension = lost ? 0 : N;
  const Matrix3 K = (lost ? 0 : k_n) * n * n.transpose() +
                    std::max(tension, 0.0) / s.distance * (Matrix3::Identity() - n * n.transpose()) + D_s;
  const Matrix3 C = cross_matrix(n0);
  const double c_i = s.l_i / s.a_i, c_j = s.l_j / s.a_j;  // rotations are stored as lengths
  const Matrix3 DC = D_s * C, CDC = C.transpose() * DC;
  const Matrix3 bend = D_r + (twisted ? 0 : law.k_t) * n0 * n0.transpose();

  Matrix6 H_ii, H_jj, H_ij;
  H_ii << K, -c_i * DC, (-c_i * DC).transpose(), c_i * c_i * CDC + bend / (s.a_i * s.a_i);
  H_jj << K, c_j * DC, (c_j * DC).transpose(), c_j * c_j * CDC + bend / (s.a_j * s.a_j);
  H_ij << -K, -c_j * DC, c_i * DC.transpose(), c_i * c_j * CDC - bend / (s.a_i * s.a_j);
  const std::int32_t i = slot_[bond.i], j = slot_[bond.j];
  matrix_.add_diagonal(i, H_ii);
  matrix_.add_diagonal(j, H_jj);
  matrix_.add_pair(b, H_ij);

  const Vector3 pull = tension * n + F_s;
  const Vector3 moment = C.transpose() * F_s, turn = M_r + M_t * n0;
  gradient_[i].head<3>() -= pull;
  gradient_[j].head<3>() += pull;
  gradient_[i].tail<3>() += c_i * moment - turn / s.a_i;
  gradient_[j].tail<3>() += c_j * moment + turn / s.a_j;
}

void ImplicitStep::linearise(const std::vector<Vector6>& q) {
  gradient_.resize(q.size());
  depth_.resize(q.size(), 0);
  matrix_.clear();
  for (std::size_t k = 0; k < active_.size(); ++k) linearise_particle(k, q[k]);
  for (std::size_t b = 0; b < state_.state.contacts.size(); ++b) linearise_bond(b, q);
}

ImplicitStep::Outcome ImplicitStep::solve(double dt, double R, double tolerance) {
  dt_ = dt;
  R_ = R;
  depth_.assign(active_.size(), 0);
  choose_surface_forces();
  Outcome outcome;
  if (active_.empty()) return {true, 0};
  double current = energy(increment_);
  for (outcome.iterations = 1; outcome.iterations <= 60; ++outcome.iterations) {
    linearise(increment_);
    if (!matrix_.factorise()) return outcome;
    matrix_.solve(gradient_, correction_);
    double slope = 0, largest = 0;
    for (std::size_t k = 0; k < correction_.size(); ++k) {
      slope -= gradient_[k].dot(correction_[k]);
      largest = std::max(largest, correction_[k].cwiseAbs().maxCoeff());
    }
    if (!std::isfinite(slope)) return outcome;
    double fraction = 1;
    for (int halving = 0; halving < 30; ++halving, fraction /= 2) {
      trial_ = increment_;
      for (std::size_t k = 0; k < trial_.size(); ++k) trial_[k] -= fraction * correction_[k];
      const double next = energy(trial_);
      // The sum of bond energies is good to about 1e-14 of itself.
      if (next <= current + 1e-4 * fraction * slope + 1e-13 * std::abs(current)) {
        current = next;
        break;
      }
    }
    increment_.swap(trial_);
    if (fraction * largest < tolerance && fraction > 0.9) {
      outcome.converged = true;
      return outcome;
    }
  }
  return outcome;
}

}  // namespace crumble
