#include "dryer/inertial.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/agglomerate/bond.hpp"
#include "dryer/drag.hpp"

namespace crumble::dryer {

Inertial::Inertial(const DryingModel& model, Agglomerate& state, double step, std::uint64_t seed)
    : Integrator(model, state, 0.1), step_(step), seed_(seed) {
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
  if (model.surface_forces) surface_pairs_.emplace(*model.surface_forces, model.droplet, laws_, state.particles, 0);
}

std::optional<double> Inertial::ionic_strength() const {
  return surface_pairs_ ? std::optional(surface_pairs_->laws().electrolyte().ionic_strength) : std::nullopt;
}

double Inertial::recommended_step(const DryingModel& model, const Particles& particles) {
  const auto smallest = std::min_element(particles.radius.begin(), particles.radius.end()) - particles.radius.begin();
  const double a = particles.radius[smallest];
  const BondLaw law(model.contact, model.material, a, a);
  double stiffest = std::max(law.normal_stiffness(), law.k_s);
  if (model.surface_forces) {
    const std::vector<double> radius{a, a};
    const BondLaws bonds(model.contact, model.material, radius);
    stiffest = std::max(stiffest, SurfaceForceLaws(*model.surface_forces, bonds, radius).largest_stiffness());
  }
  return 0.2 * std::sqrt(particles.mass[smallest] / stiffest);
}

void Inertial::step(double latest_time) {
  if (!forces_known_) evaluate_forces();  // only here is it known where the front of a resumed run is
  kick();
  drift();
  state_.state.time = std::min(state_.state.time + step_, latest_time);
  ++state_.state.step;
  evaluate_forces();
  kick();
  front_.follow(state_);
  ++statistics_.steps;
  statistics_.particle_steps += static_cast<std::int64_t>(activity_.active().size());
  if (statistics_.steps % 1000 == 0) check_finite();
}

void Inertial::check_finite() const {
  const Frame& f = state_.state;
  for (const std::int32_t p : activity_.active())
    if (!f.velocity[p].allFinite() || !f.position[p].allFinite())
      throw std::domain_error(
          fmt::format("step {} at t = {:.6g} s: particle {} is not finite; integrator.step = {:.3g} s "
                      "is too large (stable: about {:.3g} s)",
                      f.step, f.time, p, step_, recommended_step(model_, state_.particles)));
}

void Inertial::kick() {
  Frame& f = state_.state;
  for (const std::int32_t p : activity_.active()) {
    const HalfKick& k = kicks_[p];
    f.velocity[p] = k.kept * f.velocity[p] + k.gained * f.force[p];
    f.angular_velocity[p] = k.kept_rotation * f.angular_velocity[p] + k.gained_rotation * f.torque[p];
  }
}

void Inertial::drift() {
  Frame& f = state_.state;
  for (const std::int32_t p : activity_.active()) f.position[p] += step_ * f.velocity[p];
  advance_bonds([&](std::int32_t p) { return Motion{step_ * f.velocity[p], step_ * f.angular_velocity[p]}; });
}

// Three numbers, uniform in (-1/2, 1/2), that stand until the next step.
Vector3 Inertial::random_vector(Purpose purpose, std::int32_t particle) const {
  const auto words =
      random_words(seed_, purpose, static_cast<std::uint32_t>(particle), static_cast<std::uint64_t>(state_.state.step));
  return {uniform(words[0]) - 0.5, uniform(words[1]) - 0.5, uniform(words[2]) - 0.5};
}

void Inertial::evaluate_forces() {
  Frame& f = state_.state;
  const auto& radius = state_.particles.radius;
  const double R = front_.radius(f.time);
  activity_.front_at(R);
  forces_known_ = true;
  for (const std::int32_t p : activity_.active()) {
    const double r = f.position[p].norm();
    f.force[p].setZero();
    if (surface_cuts(radius[p], r, R))
      f.force[p] = -capillary_force(model_.droplet.surface_tension, radius[p], r - R) / r * f.position[p];
    f.torque[p].setZero();
    if (model_.thermal_energy == 0 || (r > R + radius[p] && !model_.dry.everything_acts)) continue;
    const double zeta = drag_coefficient(model_.viscosity, radius[p]);
    const double zeta_r = rotational_drag_coefficient(model_.viscosity, radius[p]);
    f.force[p] += random_load(model_.thermal_energy, zeta, step_) * random_vector(Purpose::brownian_force, p);
    f.torque[p] += random_load(model_.thermal_energy, zeta_r, step_) * random_vector(Purpose::brownian_torque, p);
  }
  if (surface_pairs_) {
    surface_pairs_->update(f, R);
    surface_pairs_->add_forces(f, f.force);
  }
  for (const Contact& bond : f.contacts) {
    const Vector3 force = force_on_j(bond);
    f.force[bond.j] += force;
    f.force[bond.i] -= force;
    f.torque[bond.i] += torque_on_i(bond, lever_arm(bond, radius[bond.i], radius[bond.j]));
    f.torque[bond.j] += torque_on_j(bond, lever_arm(bond, radius[bond.j], radius[bond.i]));
  }
}

Work Inertial::expected_work(const DryingModel& model, const std::vector<double>& radius, double step,
                             const StepTimes& times) {
  Work work;
  work.steps = model.droplet.lifetime / step;
  work.add_up([](double fraction) { return 1 - fraction; });
  work.seconds = 0.5 * (times.packed + times.loose) * static_cast<double>(radius.size()) * work.steps;
  return work;
}

}  // namespace crumble::dryer
