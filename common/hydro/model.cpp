#include "common/hydro/model.hpp"

#include "common/hydro/multipole.hpp"

namespace crumble {

MobilityMatrix mobility_matrix(const Spheres& spheres, const HydroModel& model) {
  if (model.rung == Rung::multipole) return multipole_mobility(spheres, model.order);
  return far_field_mobility(spheres);
}

NearFieldResistance near_field_resistance(const Spheres&, const HydroModel&) { return {}; }

}  // namespace crumble
