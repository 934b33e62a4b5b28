// A rigid agglomerate on its way along a history of the velocity gradient.
#pragma once

#include <vector>

#include "common/flow/gradient_history.hpp"
#include "rigidstress/flows.hpp"

namespace crumble::rigidstress {

struct HistoryResult {
  std::vector<Orbit> orbits;  // forces at viscosity 1 Pa s
  std::size_t worst_orbit = 0;
  double mean_peak_tension = 0;
};
HistoryResult follow_history(const LoadedBody& body, const GradientHistory& history,
                             const std::vector<Quaternion>& starts, double tolerance = 1e-8, Keeping keeping = {});

}  // namespace crumble::rigidstress
