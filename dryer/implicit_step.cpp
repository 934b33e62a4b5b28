#include "dryer/implicit_step.hpp"

#include <algorithm>
#include <cmath>

#include "dryer/drag.hpp"

namespace crumble::dryer {

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

Vector3 ImplicitStep::translation(std::int32_t particle) const {
  if (slot_[particle] < 0) return Vector3::Zero();
  return increment_[slot_[particle]].head<3>();
}

Vector3 ImplicitStep::rotation(std::int32_t particle) const {
  if (slot_[particle] < 0) return Vector3::Zero();
  return increment_[slot_[particle]].tail<3>() / state_.particles.radius[particle];
}

BondIncrement ImplicitStep::moved(const Contact& bond, const std::vector<Vector6>& q) const {
  const auto& x = state_.state.position;
  // Rotations are stored as lengths: times the radius.
  const double a_i = state_.particles.radius[bond.i], a_j = state_.particles.radius[bond.j];
  return {bond, laws_(bond.i, bond.j), {a_i, a_j, a_i, a_j}, x[bond.j] - x[bond.i], q[slot_[bond.i]], q[slot_[bond.j]]};
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
  for (const Contact& bond : state_.state.contacts) total += moved(bond, q).energy();
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

void ImplicitStep::linearise_bond(std::size_t b, const std::vector<Vector6>& q) {
  const Contact& bond = state_.state.contacts[b];
  const BondIncrement increment = moved(bond, q);
  const std::int32_t i = slot_[bond.i], j = slot_[bond.j];
  increment.add_gradient(gradient_[i], gradient_[j]);
  Matrix6 K_ii, K_ij, K_jj;
  increment.stiffness(K_ii, K_ij, K_jj);
  matrix_.add_diagonal(i, K_ii);
  matrix_.add_diagonal(j, K_jj);
  matrix_.add_pair(b, K_ij);
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

}  // namespace crumble::dryer
