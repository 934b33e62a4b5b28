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

Work work_with_noise(const DryingModel& model, const std::vector<double>& radius, const StabilisedControl& control,
                     const StepTimes& times) {
  const double a = radius.back(), N = static_cast<double>(radius.size()), phi = solids_share(model.droplet, radius);
  const double zeta = drag_coefficient(model.viscosity, a), bonds = rate_of_bonds(model, a);
  const Droplet& droplet = model.droplet;
  const double interval = ThermalLoads::interval(model, a, control.brownian_displacement);
  const double peclet = droplet.peclet(model.thermal_energy / zeta);
  const auto stages = [&](double fraction) {
    const double R = droplet.initial_radius * (1 - fraction);
    const double dt = std::min(interval, control.largest_displacement * a / droplet.front_speed(R));
    const double rate = std::max(bonds, 4 * ThermalLoads::surface_rate(model, a, interval, R));
    return 2 * (1 - fraction) * droplet.lifetime / dt * Chebyshev::stages(dt, rate);
  };
  Work work;
  work.steps = work.add_up(stages);
  work.seconds = N * times.packed * work.add_up([&](double fraction) {
    const double R = 1 - fraction, packing = std::min(phi / (R * R * R), 0.64);
    const double met = std::max(share_near(packing, a, control.near(true) * a, 0),
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
    return 1.5 * std::sqrt(R) * std::min(1.0, 1 - R * R * R + 0.5 * phi / (R * R * R));
  });
  work.seconds = 0.75 / std::max(swept, 0.5) * swept * work.steps * static_cast<double>(radius.size()) * times.packed;
  return work;
}

}  // namespace crumble::dryer
