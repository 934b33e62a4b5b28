#include "common/hydro/model.hpp"

#include <stdexcept>

namespace crumble {

MobilityMatrix mobility_matrix(const Spheres& spheres, const HydroModel& model) {
  if (model.rung == Rung::multipole) throw std::invalid_argument("multipole: not yet");
  return far_field_mobility(spheres);
}

NearFieldResistance near_field_resistance(const Spheres&, const HydroModel&) { return {}; }

}  // namespace crumble
