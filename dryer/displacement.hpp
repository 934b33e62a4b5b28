// By what motion the step of an integrator is judged.
#pragma once

#include <algorithm>
#include <vector>

namespace crumble::dryer {

// Largest displacement in a step, in the radius, unless the scene says another.
inline constexpr double usual_displacement = 0.02;

// How much farther than the step's largest displacement the few may go that snap into a new place: fewer than one
// particle in a thousand. They must not slow down a large droplet: their number grows with that of the particles.
inline constexpr double snap = 5;

// Of the displacements of all that move the one that counts: the largest, with those that snap at 1/snap. 0 of none.
// The order of the list is lost.
inline double largest_but_snaps(std::vector<double>& moves) {
  if (moves.empty()) return 0;
  const auto place = moves.end() - 1 - static_cast<std::ptrdiff_t>(moves.size() / 1000);
  std::nth_element(moves.begin(), place, moves.end());
  return std::max(*place, *std::max_element(place, moves.end()) / snap);
}

}  // namespace crumble::dryer
