// Resistance scalars of two spheres at any gap, from the stored table.
#pragma once

#include "common/hydro/two_sphere_scalars.hpp"

namespace crumble {

// Scalars of sphere 1 of a pair (conventions and unit: ResistanceScalars).
//   gap: surface separation over the mean radius (a1+a2)/2 (over a for equal spheres), > 0, infinity allowed
//   radius_ratio: a2/a1. Sphere 2's own scalars are those of the ratio a1/a2, see swapped().
// Source: series of two_sphere_series.hpp, stored as Chebyshev series after subtraction of near_field.hpp; error
// measured in common/hydro/TWO_SPHERES.md. Throws std::invalid_argument for a gap <= 0 (or not a number) and for a
// ratio that is not tabulated.
ResistanceScalars two_sphere_resistance(double gap, double radius_ratio = 1);
bool is_tabulated(double radius_ratio);  // from 0.1 to 10

// The same scalars seen from the other sphere: with f computed for a1/a2, swapped(f) holds f22 and f21 for the axis
// that still points from 1 to 2. Forces and torques of odd parity (YB, XG, YG) change sign.
ResistanceScalars swapped(const ResistanceScalars& f);

// Gap at which lubrication is evaluated: the gap itself down to a floor, the floor for everything closer, overlapping
// spheres included (contact deformation, gap < 0). Continuous; gap and floor in mean radii. The only place where a
// floor is applied.
inline constexpr double default_gap_floor = 1e-6;
inline double effective_gap(double gap, double floor = default_gap_floor) { return gap < floor ? floor : gap; }

// The distance of centres that belongs to the effective gap. In a pair that moves as a rigid body the singular terms
// cancel only if the centres are as far apart as the scalars believe, so rigid modes and the ambient velocity
// difference of a pair at the floor are to be taken at this distance. Scalars at a floor with the lever arms of
// touching spheres lose 1/xi times the mismatch: 12.3 % of the bond tension of a doublet in elongation, however small
// the floor is.
inline double effective_distance(double distance, double mean_radius, double floor = default_gap_floor) {
  return mean_radius * (2 + effective_gap(distance / mean_radius - 2, floor));
}

}  // namespace crumble
