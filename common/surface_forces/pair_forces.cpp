#include "common/surface_forces/pair_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/surface_forces/surface_charge.hpp"

namespace crumble {

double surface_potential(const SurfaceForces& forces, const Electrolyte& electrolyte, double a) {
  return forces.surface_charge ? surface_potential(electrolyte, a, *forces.surface_charge) : forces.surface_potential;
}

double effective_potential(const SurfaceForces& forces, const Electrolyte& electrolyte, double a) {
  const double potential = surface_potential(forces, electrolyte, a);
  return potential == 0 ? 0 : effective_potential(electrolyte, a, potential);
}

SurfaceForceLaws::SurfaceForceLaws(const SurfaceForces& forces, const BondLaws& contacts,
                                   const std::vector<double>& radius)
    : forces_(forces),
      contacts_(contacts),
      radius_(radius),
      largest_(static_cast<std::int32_t>(std::max_element(radius.begin(), radius.end()) - radius.begin())),
      equal_(std::all_of(radius.begin(), radius.end(), [&](double a) { return a == radius.front(); })) {
  shared_ = JoinedAttraction(
      {forces.hamaker, radius[largest_], radius[largest_], retardation_rate(forces.retardation_wavelength)},
      contacts(largest_, largest_));
  set_ionic_strength(forces.electrolyte.ionic_strength);
}

void SurfaceForceLaws::set_ionic_strength(double ionic_strength) {
  electrolyte_ = forces_.electrolyte;
  electrolyte_.ionic_strength = ionic_strength;
  effective_.resize(equal_ ? 1 : radius_.size());
  for (std::size_t p = 0; p < effective_.size(); ++p)
    effective_[p] = p > 0 && radius_[p] == radius_[p - 1] ? effective_[p - 1]
                                                          : effective_potential(forces_, electrolyte_, radius_[p]);
  find_range();
}

const JoinedAttraction& SurfaceForceLaws::attraction(std::int32_t i, std::int32_t j) const {
  if (equal_ || (radius_[i] == radius_[largest_] && radius_[j] == radius_[largest_])) return shared_;
  const std::uint64_t key = static_cast<std::uint64_t>(i) << 32 | static_cast<std::uint32_t>(j);
  const auto found = pairs_.find(key);
  if (found != pairs_.end()) return found->second;
  const VanDerWaals outer{forces_.hamaker, radius_[i], radius_[j], retardation_rate(forces_.retardation_wavelength)};
  return pairs_.emplace(key, JoinedAttraction(outer, contacts_(i, j))).first->second;
}

PairForces SurfaceForceLaws::operator()(std::int32_t i, std::int32_t j) const {
  const double Y_i = effective_[equal_ ? 0 : i], Y_j = effective_[equal_ ? 0 : j];
  return {attraction(i, j), double_layer(electrolyte_, radius_[i], radius_[j], Y_i, Y_j), range_};
}

// Both energies fall with the gap.
void SurfaceForceLaws::find_range() {
  if (forces_.range) {
    range_ = *forces_.range;
    return;
  }
  range_ = std::numeric_limits<double>::infinity();
  const PairForces pair = (*this)(largest_, largest_);
  const double enough = negligible_energy * electrolyte_.thermal_energy;
  const auto felt = [&](double gap) {
    return std::max(-pair.attraction.energy(gap), pair.repulsion.energy(gap)) > enough;
  };
  double low = 0, high = 1e-10;
  while (felt(high)) low = std::exchange(high, 2 * high);
  while (high - low > 1e-6 * high) (felt(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  range_ = high;
}

// Slope of the tension of an open pair, as if nothing ended at `range`, N/m.
double SurfaceForceLaws::slope(double gap) const {
  constexpr double width = 1e-4;
  const PairForces pair = (*this)(largest_, largest_);
  const auto tension = [&](double h) { return pair.attraction.tension(h) + pair.repulsion.tension(h); };
  return (tension(gap * (1 + width)) - tension(gap)) / (width * gap);
}

// In steps of the gap that are small against every length of the law.
double SurfaceForceLaws::largest_stiffness() const {
  double stiffest = 0;
  for (double h = 1e-3 * shared_.joined_gap(); h < range_; h *= 1.02) stiffest = std::max(stiffest, std::abs(slope(h)));
  return stiffest;
}

double SurfaceForceLaws::gap_of_stiffness(double bound) const {
  double h = range_;
  while (h > 1e-3 * shared_.joined_gap() && std::abs(slope(0.98 * h)) < bound) h *= 0.98;
  return h;
}

}  // namespace crumble
