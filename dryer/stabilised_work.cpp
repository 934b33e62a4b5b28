// What stabilised steps expect to cost.
#include <algorithm>
#include <cmath>

#include "dryer/drag.hpp"
#include "dryer/stabilised.hpp"

namespace crumble::dryer {

namespace {

// Of what holds a packed cluster together, 1/s.
double rate_of_bonds(const DryingModel& model, double a) {
  const BondLaw law(model.contact, model.material, a, a);
  return 12 * std::max(law.normal_stiffness(), law.k_s) / drag_coefficient(model.viscosity, a);
}

// Of the double layers of six neighbours in touch, 1/s.
double rate_of_repulsion(const DryingModel& model, double a, double solids, double R) {
  if (!model.surface_forces) return 0;
  const SurfaceForces& forces = *model.surface_forces;
  const double before = std::pow(model.droplet.initial_radius, 3) - solids;
  Electrolyte salt = forces.electrolyte;
  salt.ionic_strength =
      concentrated(salt.ionic_strength, before, std::max(R * R * R - solids, 1e-9 * before), forces.solubility);
  const double Y = effective_potential(forces, salt, a);
  return 12 * double_layer(salt, a, a, Y, Y).stiffness(0) / drag_coefficient(model.viscosity, a);
}

Work work_with_noise(const DryingModel& model, const std::vector<double>& radius, const StabilisedControl& control,
                     const StepTimes& times) {
  const double a = radius.back(), N = static_cast<double>(radius.size()), phi = solids_share(model.droplet, radius);
  const double zeta = drag_coefficient(model.viscosity, a), bonds = rate_of_bonds(model, a);
  const Droplet& droplet = model.droplet;
  const double interval = ThermalLoads::interval(model, a, control.brownian_displacement);
  const double solids = phi * std::pow(droplet.initial_radius, 3);
  const double peclet = droplet.peclet(model.thermal_energy / zeta);
  const auto stages = [&](double fraction) {
    const double R = droplet.initial_radius * (1 - fraction);
    const double dt = std::min(interval, control.largest_displacement * a / droplet.front_speed(R));
    const double rate =
        std::max(bonds + rate_of_repulsion(model, a, solids, R), 4 * ThermalLoads::surface_rate(model, a, interval, R));
    return 2 * (1 - fraction) * droplet.lifetime / dt * Chebyshev::stages(dt, rate);
  };
  Work work;
  work.steps = work.add_up(stages);
  work.seconds = N * times.packed * work.add_up([&](double fraction) {
    const double R = 1 - fraction, packing = std::min(phi / (R * R * R), 0.64);
    const double stiff =
        stiff_gap(model, a, Stabilised::soft_stiffness(model, a, control), solids, R * droplet.initial_radius);
    const double met = std::max(share_near(packing, a, control.near(true) * a + stiff, 0),
                                share_clustered(model, N, (1 - R * R) * droplet.lifetime));
    const double swept = (1 - R * R * R) * peclet / (peclet + 20);
    return stages(fraction) * (swept + (1 - swept) * met);
  });
  return work;
}

}  // namespace

Work Stabilised::expected_work(const DryingModel& model, const std::vector<double>& radius,
                               const StabilisedControl& control, const StepTimes& times) {
  if (model.thermal_energy > 0) return work_with_noise(model, radius, control, times);
  const double a = radius.back(), zeta = drag_coefficient(model.viscosity, a);
  const Droplet& droplet = model.droplet;
  const double fastest = std::max(rate_of_bonds(model, a), 4 * surface_rate(droplet, a, zeta, droplet.initial_radius));
  const double advance = droplet.initial_radius / a / control.largest_displacement;
  Work work;
  work.steps = 2.0 / 3 * std::sqrt(2.5 * fastest * droplet.lifetime * advance);
  // Evaluations for the front's way go like the root of R; those swept so far are awake, three quarters on average.
  const double phi = solids_share(droplet, radius);
  const double swept = work.add_up([&](double fraction) {
    const double R = 1 - fraction;
    // With surface forces all move from the start.
    const double awake = model.surface_forces ? 1 : std::min(1.0, 1 - R * R * R + 0.5 * phi / (R * R * R));
    return 1.5 * std::sqrt(R) * awake;
  });
  const double share = model.surface_forces ? 1 : 0.75 / std::max(swept, 0.5) * swept;
  work.seconds = share * work.steps * static_cast<double>(radius.size()) * times.packed;
  return work;
}

}  // namespace crumble::dryer
