#include "dryer/work.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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

double share_near(double packing, double a, double margin, double stickiness) {
  const double shell = std::pow(1 + margin / (2 * a), 3) - 1 + 3 * std::min(stickiness, 100 * a) / (2 * a);
  return 1 - std::exp(-8 * packing * shell);
}

double share_clustered(const DryingModel& model, double number, double time) {
  const double R = model.droplet.initial_radius;
  const double density = number / (4.0 / 3 * std::numbers::pi * R * R * R);
  const double half = 3 * model.viscosity / (4 * model.thermal_energy * density);
  return time / (time + half);
}

}  // namespace crumble::dryer
