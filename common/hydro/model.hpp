// The ladder of hydrodynamic models and what each needs to know.
#pragma once

#include "common/hydro/far_field.hpp"
#include "common/hydro/lubrication.hpp"

namespace crumble {

enum class Rung { fts, fts_lubrication, fts_relative_lubrication, multipole };

struct HydroModel {
  Rung rung = Rung::fts;
  int order = 3;                         // multipole: moments of the surface force up to this degree; 1 is fts
  double lubrication_range = 2.5;        // lubrication: pairs with distance below this times their mean radius
  double gap_floor = default_gap_floor;  // lubrication: closer pairs are taken at this gap, in mean radii
};

// Far-field mobility and added pair resistance (viscosity 1).
MobilityMatrix mobility_matrix(const Spheres& spheres, const HydroModel& model);
Lubrication lubrication(const Spheres& spheres, const HydroModel& model);

}  // namespace crumble
