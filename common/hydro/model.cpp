#include "common/hydro/model.hpp"

#include "common/hydro/multipole.hpp"

namespace crumble {

MobilityMatrix mobility_matrix(const Spheres& spheres, const HydroModel& model) {
  if (model.rung == Rung::multipole) return multipole_mobility(spheres, model.order);
  return far_field_mobility(spheres);
}

Lubrication lubrication(const Spheres& spheres, const HydroModel& model) {
  switch (model.rung) {
    case Rung::fts_lubrication:
      return {spheres, model.lubrication_range, PairMotion::all, model.gap_floor};
    case Rung::fts_relative_lubrication:
      return {spheres, model.lubrication_range, PairMotion::relative, model.gap_floor};
    case Rung::fts:
    case Rung::multipole:
      break;
  }
  return {};
}

}  // namespace crumble
