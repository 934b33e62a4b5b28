#include "dryer/thermal_loads.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dryer/drag.hpp"

namespace crumble::dryer {

double ThermalLoads::interval(const DryingModel& model, double a, double displacement) {
  const double D = model.thermal_energy / drag_coefficient(model.viscosity, a);
  return displacement * displacement * a * a / (6 * D);
}

double ThermalLoads::surface_rate(const DryingModel& model, double a, double interval, double R) {
  const double zeta = drag_coefficient(model.viscosity, a),
               thermal = std::sqrt(2 * model.thermal_energy / zeta / interval);
  return dryer::surface_rate(model.droplet, a, zeta, R) * std::min(1.0, model.droplet.front_speed(R) / thermal);
}

ThermalLoads::ThermalLoads(const DryingModel& model, const std::vector<double>& radius, std::uint64_t seed,
                           double displacement)
    : displacement_(displacement),
      interval_(interval(model, *std::min_element(radius.begin(), radius.end()), displacement)),
      path_(seed),
      stride_(padded(radius.size())),
      particle_(radius.size()) {
  std::iota(particle_.begin(), particle_.end(), 0);
  const double unit = 2 * model.thermal_energy / interval_;
  for (const double a : radius) {
    drag_.push_back(drag_coefficient(model.viscosity, a));
    force_.push_back(std::sqrt(unit * drag_.back()));
    torque_.push_back(std::sqrt(unit * rotational_drag_coefficient(model.viscosity, a)));
  }
}

void ThermalLoads::advance_to(double time) {
  const std::uint64_t before = index_;
  while (time >= end()) ++index_;
  if (index_ != before || normal_.empty()) path_.fill(particle_, index_, 0, stride_, normal_);
}

SixVector ThermalLoads::load(std::size_t p) const {
  SixVector load;
  for (std::size_t k = 0; k < 3; ++k) {
    load.at[k] = static_cast<float>(force_[p] * random(k, p));
    load.at[4 + k] = static_cast<float>(torque_[p] * random(3 + k, p));
  }
  return load;
}

Vector3 ThermalLoads::velocity(std::size_t p) const {
  return force_[p] / drag_[p] * Vector3(random(0, p), random(1, p), random(2, p));
}

}  // namespace crumble::dryer
