#include "dryer/inertial.hpp"

#include <algorithm>
#include <cmath>

#include "common/agglomerate/bond.hpp"
#include "dryer/drag.hpp"

namespace crumble {

Inertial::Inertial(const DryingModel& model, Agglomerate& state, double step)
    : model_(model),
      state_(state),
      step_(step),
      laws_(model.contact, model.material, state.particles.radius),
      open_(0.1 * *std::min_element(state.particles.radius.begin(), state.particles.radius.end())),
      activity_(state.particles, state.state) {
  Frame& f = state.state;
  for (auto* field : {&f.velocity, &f.angular_velocity, &f.force, &f.torque})
    if (field->size() != state.particles.size()) field->assign(state.particles.size(), Vector3::Zero());
  for (std::size_t p = 0; p < state.particles.size(); ++p) {
    const double a = state.particles.radius[p], m = state.particles.mass[p];
    const double zeta = drag_coefficient(model.viscosity, a);
    const double zeta_r = rotational_drag_coefficient(model.viscosity, a);
    const double e = -0.5 * zeta * step / m, e_r = -0.5 * zeta_r * step / (0.4 * m * a * a);
    kicks_.push_back({std::exp(e), -std::expm1(e) / zeta, std::exp(e_r), -std::expm1(e_r) / zeta_r});
  }
  activity_.front_at(model.droplet.radius(f.time));
  open_.update(f.position, state.particles.radius, f.contacts);
  evaluate_forces();
}

double Inertial::recommended_step(const DryingModel& model, const Particles& particles) {
  const auto smallest = std::min_element(particles.radius.begin(), particles.radius.end()) - particles.radius.begin();
  const double a = particles.radius[smallest];
  const BondLaw law(model.contact, model.material, a, a);
  return 0.2 * std::sqrt(particles.mass[smallest] / std::max(law.normal_stiffness(), law.k_s));
}

void Inertial::step() {
  kick();
  drift();
  evaluate_forces();
  kick();
  ++state_.state.step;
}

void Inertial::kick() {
  Frame& f = state_.state;
  for (const std::int32_t p : activity_.active()) {
    const Mobility& k = kicks_[p];
    f.velocity[p] = k.kept * f.velocity[p] + k.gained * f.force[p];
    f.angular_velocity[p] = k.kept_rotation * f.angular_velocity[p] + k.gained_rotation * f.torque[p];
  }
}

void Inertial::drift() {
  Frame& f = state_.state;
  const auto& radius = state_.particles.radius;
  for (const std::int32_t p : activity_.active()) f.position[p] += step_ * f.velocity[p];
  f.time += step_;
  open_.update(f.position, radius, f.contacts);

  bool lost = false;
  for (Contact& bond : f.contacts) {
    const BondLaw& law = laws_(bond.i, bond.j);
    advance(bond, law,
            {f.position[bond.j] - f.position[bond.i], step_ * (f.velocity[bond.j] - f.velocity[bond.i]),
             step_ * f.angular_velocity[bond.i], step_ * f.angular_velocity[bond.j], radius[bond.i], radius[bond.j]});
    if (bond.gap > law.lost_gap()) {
      open_.open({bond.i, bond.j});
      bond.born = -1;
      lost = true;
    }
  }
  if (lost) std::erase_if(f.contacts, [](const Contact& bond) { return bond.born < 0; });

  std::vector<Pair> made;
  for (const Pair& pair : open_.pairs()) {
    const double reach = radius[pair.i] + radius[pair.j];
    if ((f.position[pair.j] - f.position[pair.i]).squaredNorm() <= reach * reach &&
        (activity_.is_active(pair.i) || activity_.is_active(pair.j)))
      made.push_back(pair);
  }
  for (const Pair& pair : made) {
    open_.close(pair);
    activity_.wake(pair.i);
    activity_.wake(pair.j);
    Contact bond = make_bond(laws_(pair.i, pair.j), pair.i, pair.j, f.position[pair.j] - f.position[pair.i],
                             radius[pair.i], radius[pair.j], f.step);
    const auto place =
        std::lower_bound(f.contacts.begin(), f.contacts.end(), pair, [](const Contact& c, const Pair& q) {
          return Pair{c.i, c.j} < q;
        });
    f.contacts.insert(place, bond);
  }
}

void Inertial::evaluate_forces() {
  Frame& f = state_.state;
  const auto& radius = state_.particles.radius;
  const double R = model_.droplet.radius(f.time);
  activity_.front_at(R);
  for (const std::int32_t p : activity_.active()) {
    const double r = f.position[p].norm();
    const double F_c = R > 0 ? capillary_force(model_.droplet.surface_tension, radius[p], r - R) : 0;
    f.force[p] = r > 0 ? Vector3(-F_c / r * f.position[p]) : Vector3::Zero();
    f.torque[p].setZero();
  }
  for (const Contact& bond : f.contacts) {
    const Vector3 force = force_on_j(bond);
    f.force[bond.j] += force;
    f.force[bond.i] -= force;
    f.torque[bond.i] += torque_on_i(bond, lever_arm(bond, radius[bond.i], radius[bond.j]));
    f.torque[bond.j] += torque_on_j(bond, lever_arm(bond, radius[bond.j], radius[bond.i]));
  }
}

}  // namespace crumble
