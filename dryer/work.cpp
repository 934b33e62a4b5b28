#include "dryer/work.hpp"

#include <algorithm>
#include <cmath>

namespace crumble::dryer {

double Work::share(double fraction) const {
  const double place = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(done.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), done.size() - 2);
  return done[below] + (place - static_cast<double>(below)) * (done[below + 1] - done[below]);
}

double solids_share(const Droplet& droplet, const std::vector<double>& radius) {
  double solids = 0;
  for (const double a : radius) solids += std::pow(a / droplet.initial_radius, 3);
  return solids;
}

}  // namespace crumble::dryer
