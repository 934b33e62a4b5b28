// The life of one bond: its history under the motion of its two spheres, and the loads that follow.
#pragma once

#include "common/agglomerate/agglomerate.hpp"
#include "common/contact/bond_law.hpp"

namespace crumble {

// What the two spheres of a bond did since the bond was last advanced.
struct BondMotion {
  Vector3 separation;              // x_j - x_i now, m
  Vector3 displacement;            // dx_j - dx_i, m
  Vector3 rotation_i, rotation_j;  // rotation vectors, rad
  double radius_i, radius_j;       // m
};

// Moves the bond to its new geometry: gap and normal, histories carried along with the co-rotating frame and increased
// by the relative motion (measured at the mid normal: second order in the step). Limits and loads are left alone.
void carry(Contact& bond, const BondMotion& motion);

// The same, with the histories capped by the limits of Eqs. 12-21; then the loads on j. Any motion of the pair as a
// rigid body changes no load.
void advance(Contact& bond, const BondLaw& law, const BondMotion& motion);

// Loads on j from gap and histories as they stand; sets normal_force, sliding_force, twisting_torque, rolling_torque.
void evaluate_loads(Contact& bond, const BondLaw& law);

// Force on j, N; the force on i is opposite.
inline Vector3 force_on_j(const Contact& bond) { return bond.sliding_force - bond.normal_force * bond.normal; }

// Torques, N m: the sliding force acts at the contact point, at the lever arm l_i from i and l_j from j.
inline Vector3 torque_on_j(const Contact& bond, double l_j) {
  return bond.rolling_torque + bond.twisting_torque * bond.normal - l_j * bond.normal.cross(bond.sliding_force);
}
inline Vector3 torque_on_i(const Contact& bond, double l_i) {
  return -bond.rolling_torque - bond.twisting_torque * bond.normal - l_i * bond.normal.cross(bond.sliding_force);
}

// The lever arms divide the distance of centres in the ratio of the radii.
inline double lever_arm(const Contact& bond, double radius, double other_radius) {
  return radius * (1 + bond.gap / (radius + other_radius));
}

// A new bond of touching spheres, without history.
Contact make_bond(const BondLaw& law, std::int32_t i, std::int32_t j, const Vector3& separation, double radius_i,
                  double radius_j, std::int64_t step);

}  // namespace crumble
