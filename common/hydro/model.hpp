// The ladder of hydrodynamic models and what each needs to know.
#pragma once

#include "common/hydro/far_field.hpp"
#include "common/hydro/near_field_resistance.hpp"

namespace crumble {

enum class Rung { fts, fts_lubrication, fts_relative_lubrication, multipole };

struct HydroModel {
  Rung rung = Rung::fts;
  int order = 3;                   // multipole: moments of the surface force up to this degree; 1 is fts
  double lubrication_range = 2.5;  // lubrication: pairs with distance below this times their mean radius
};

// Far-field mobility and added near-field resistance of reduced spheres (viscosity 1).
MobilityMatrix mobility_matrix(const Spheres& spheres, const HydroModel& model);
NearFieldResistance near_field_resistance(const Spheres& spheres, const HydroModel& model);

}  // namespace crumble
