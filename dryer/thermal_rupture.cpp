#include "dryer/thermal_rupture.hpp"

#include <cmath>

#include "dryer/drag.hpp"

namespace crumble::dryer {

ThermalRupture thermal_rupture(const DryingModel& model, double number, double smallest_radius) {
  const Jkr law(model.material, smallest_radius);
  const double rate = law.tangent_stiffness() / drag_coefficient(model.viscosity, smallest_radius);
  const double attempts = 3 * number * model.droplet.lifetime / model.crust_diffusivity * rate;
  ThermalRupture rupture;
  rupture.bond = law.energy(law.pull_off_gap) / model.thermal_energy;
  rupture.most = attempts * std::exp(-rupture.bond);
  return rupture;
}

}  // namespace crumble::dryer
