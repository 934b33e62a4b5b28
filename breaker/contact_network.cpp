#include "breaker/contact_network.hpp"

#include <algorithm>
#include <utility>

#include "common/agglomerate/network.hpp"

namespace crumble::breaker {

using Eigen::VectorXd;

namespace {
double smallest(const std::vector<double>& radius) { return *std::min_element(radius.begin(), radius.end()); }
constexpr double skin = 0.3;  // of the smallest radius
}  // namespace

ContactNetwork::ContactNetwork(const ContactChoice& choice, const Material& material, const std::vector<double>& radius,
                               Frame& frame, const std::optional<SurfaceForces>& surface_forces)
    : radius_(radius), frame_(frame), laws_(choice, material, radius), open_(skin * smallest(radius)) {
  for (Contact& bond : frame.contacts) evaluate_loads(bond, laws_(bond.i, bond.j));
  open_.update(frame.position, radius, frame.contacts);
  make_contacts(0);
  events_.clear();
  if (!surface_forces) return;
  surface_pairs_.emplace(*surface_forces, laws_, radius);
  surface_pairs_->update(frame);
}

void ContactNetwork::add_loads(double length, VectorXd& loads) const {
  for (const Contact& bond : frame_.contacts) {
    const double a_i = radius_[bond.i], a_j = radius_[bond.j];
    const Vector3 force = force_on_j(bond);
    loads.segment<3>(6 * bond.i) -= force;
    loads.segment<3>(6 * bond.j) += force;
    loads.segment<3>(6 * bond.i + 3) += torque_on_i(bond, lever_arm(bond, a_i, a_j)) / length;
    loads.segment<3>(6 * bond.j + 3) += torque_on_j(bond, lever_arm(bond, a_j, a_i)) / length;
  }
  if (surface_pairs_) surface_pairs_->add_loads(frame_, loads);
}

void ContactNetwork::tell_limits(const Contact& bond, double stress) {
  if (bond.at_limit == 0) return;
  std::uint8_t& told = told_[{bond.i, bond.j}];
  for (const auto& [bit, kind] : {std::pair{limit::sliding, EventKind::slip},
                                  {limit::twisting, EventKind::twist},
                                  {limit::rolling, EventKind::roll}})
    if (bond.at_limit & ~told & bit) events_.push_back({frame_.time, stress, kind, bond.i, bond.j, {}});
  told |= bond.at_limit;
}

bool ContactNetwork::advance(const VectorXd& q, double length, double stress) {
  bool lost = false;
  for (Contact& bond : frame_.contacts) {
    const auto q_i = q.segment<6>(6 * bond.i), q_j = q.segment<6>(6 * bond.j);
    const BondMotion motion{frame_.position[bond.j] - frame_.position[bond.i],
                            q_j.head<3>() - q_i.head<3>(),
                            q_i.tail<3>() / length,
                            q_j.tail<3>() / length,
                            radius_[bond.i],
                            radius_[bond.j]};
    if (advance_or_lose(bond, laws_(bond.i, bond.j), motion, open_)) {
      events_.push_back({frame_.time, stress, EventKind::rupture, bond.i, bond.j, {}});
      told_.erase({bond.i, bond.j});
      lost = true;
    } else {
      tell_limits(bond, stress);
    }
  }
  if (lost) drop_lost(frame_.contacts);
  open_.update(frame_.position, radius_, frame_.contacts);
  const bool made = make_contacts(stress);
  if (surface_pairs_) surface_pairs_->update(frame_);
  return made || lost;
}

bool ContactNetwork::make_contacts(double stress) {
  const std::vector<Pair> touch = touching(open_, frame_.position, radius_);
  for (const Pair& pair : touch) {
    make_bond(pair, laws_, radius_, frame_, open_);
    events_.push_back({frame_.time, stress, EventKind::made, pair.i, pair.j, {}});
  }
  return !touch.empty();
}

double ContactNetwork::touch_fraction(const VectorXd& q, double precision) const {
  double first = 1;
  for (const Pair& pair : open_.pairs()) {
    const double a_i = radius_[pair.i], a_j = radius_[pair.j], allowed = precision * pair_radius(a_i, a_j);
    const Vector3 before = frame_.position[pair.j] - frame_.position[pair.i];
    const Vector3 after = before + q.segment<3>(6 * pair.j) - q.segment<3>(6 * pair.i);
    const double gap = before.norm() - a_i - a_j, end = after.norm() - a_i - a_j;
    if (end > -allowed) continue;
    // Aim at half the precision, so that the secant lands within it.
    first = std::min(first, std::clamp((gap + 0.5 * allowed) / (gap - end), 0.0, 0.9));
  }
  return first;
}

bool ContactNetwork::ruptures(const VectorXd& q) const {
  for (const Contact& bond : frame_.contacts) {
    const Vector3 after =
        frame_.position[bond.j] - frame_.position[bond.i] + q.segment<3>(6 * bond.j) - q.segment<3>(6 * bond.i);
    if (after.norm() - radius_[bond.i] - radius_[bond.j] > laws_(bond.i, bond.j).lost_gap()) return true;
  }
  return false;
}

std::vector<Event> ContactNetwork::take_events() {
  std::vector<Event> taken;
  taken.swap(events_);
  return taken;
}

// Limits that contacts have reached so far. Events are taken after every step.
void ContactNetwork::fields(SavedFields& f) {
  std::vector<std::int32_t> i, j;
  std::vector<std::uint8_t> limits;
  for (const auto& [pair, bits] : told_) i.push_back(pair.i), j.push_back(pair.j), limits.push_back(bits);
  f("limits_reached.i", i);
  f("limits_reached.j", j);
  f("limits_reached.bits", limits);
  for (std::size_t k = 0; k < limits.size(); ++k) told_[{i.at(k), j.at(k)}] = limits[k];
}

NetworkState network_state(const std::vector<Contact>& contacts, const BondLaws& laws) {
  NetworkState s;
  for (const Contact& bond : contacts) {
    s.max_tension = std::max(s.max_tension, bond.normal_force);
    s.max_use = std::max(s.max_use, bond.normal_force / laws(bond.i, bond.j).pull_off_force());
    s.slipping += (bond.at_limit & limit::sliding) != 0;
    s.twisting += (bond.at_limit & limit::twisting) != 0;
    s.rolling += (bond.at_limit & limit::rolling) != 0;
  }
  return s;
}

}  // namespace crumble::breaker
