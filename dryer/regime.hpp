// What follows from a scene before anything is run.
#pragma once

#include <string>
#include <vector>

#include "common/io/report.hpp"
#include "dryer/scene.hpp"

namespace crumble::dryer {

struct DryingRegime {
  double solids_fraction = 0;       // phi = sum a^3/R0^3
  double diffusivity = 0;           // D, m^2/s                                               (Eq. 23)
  double peclet = 0;                // Pe = R0^2/(D tau) = k/D, infinite where D = 0           (Eq. 22)
  double evaporation_constant = 0;  // k = R0^2/tau, m^2/s
  double front_speed = 0;           // v = k/(2 R0), m/s, at the start
  double packed_front_speed = 0;    // v where the solids fill half of the droplet, m/s
  double capillary_speed = 0;       // sigma/(3 mu), m/s: the largest force of Eq. 8 against the drag of Eq. 2, any a

  double force_ratio = 0;  // largest capillary force (Eq. 8) over the pull-off force (Eq. 6) of a bond

  // Below this radius the front is faster than any particle can follow and leaves it dry, m.
  double outrun_radius() const { return evaporation_constant / (2 * capillary_speed); }

  bool diffusion_dominated() const { return peclet < 20; }
  bool advection_dominated() const { return peclet > 100; }
  bool capillary_limited() const { return packed_front_speed > capillary_speed; }
  std::string words() const;
};

DryingRegime drying_regime(const DryingScene& scene);
// Of particles of radius a, m, that take up a share of the droplet at the start.
DryingRegime drying_regime(const DryingModel& model, double a, double solids_fraction);

// For people, a line each.
std::vector<std::string> describe(const DryingScene& scene);

// For the report: what follows from the gas, of the real droplet, in the group `gas`.
void report_gas(Report& report, const GasSide& side);

// For the report: the derived numbers in the group `inputs`, the regime in words.
void report_regime(Report& report, const DryingScene& scene);

}  // namespace crumble::dryer
