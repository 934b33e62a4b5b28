#include "common/agglomerate/bond.hpp"

#include <stdexcept>

#include "common/contact/kinematics.hpp"
#include "common/contact/plastic_spring.hpp"

namespace crumble {

namespace {

void set_geometry(Contact& bond, const Vector3& separation, double radius_i, double radius_j) {
  const double distance = separation.norm();
  if (!(distance > 0) || !std::isfinite(distance))
    throw std::domain_error("bond " + std::to_string(bond.i) + "-" + std::to_string(bond.j) +
                            ": centres coincide or are not finite (step too large?)");
  bond.normal = separation / distance;
  bond.gap = distance - radius_i - radius_j;
}

}  // namespace

void evaluate_loads(Contact& bond, const BondLaw& law) {
  bond.normal_force = law.normal(bond.gap).tension;
  bond.sliding_force = -law.k_s * bond.sliding;
  bond.twisting_torque = -law.k_t * bond.twisting;
  bond.rolling_torque = -law.k_r * bond.rolling;
}

void carry(Contact& bond, const BondMotion& motion) {
  const Vector3 normal_before = bond.normal;
  set_geometry(bond, motion.separation, motion.radius_i, motion.radius_j);
  const Vector3 mid = (normal_before + bond.normal).normalized();
  const double l_i = lever_arm(bond, motion.radius_i, motion.radius_j);
  const double l_j = lever_arm(bond, motion.radius_j, motion.radius_i);
  const RelativeMotion relative =
      relative_motion(mid, motion.displacement, motion.rotation_i, motion.rotation_j, l_i, l_j);
  const FrameRotation frame(normal_before, bond.normal, 0.5 * mid.dot(motion.rotation_i + motion.rotation_j));
  frame.apply(bond.sliding);
  frame.apply(bond.rolling);
  bond.sliding += relative.sliding - bond.normal.dot(relative.sliding) * bond.normal;
  bond.rolling += relative.rolling - bond.normal.dot(relative.rolling) * bond.normal;
  bond.twisting += relative.twisting;
}

void advance(Contact& bond, const BondLaw& law, const BondMotion& motion) {
  carry(bond, motion);
  const double tension = law.normal(bond.gap).tension;
  bond.at_limit = static_cast<std::uint8_t>(yield(bond.sliding, law.k_s, law.sliding_limit(tension)) * limit::sliding +
                                            yield(bond.twisting, law.k_t, law.M_t_crit) * limit::twisting +
                                            yield(bond.rolling, law.k_r, law.M_r_crit) * limit::rolling);
  evaluate_loads(bond, law);
}

Contact make_bond(const BondLaw& law, std::int32_t i, std::int32_t j, const Vector3& separation, double radius_i,
                  double radius_j, std::int64_t step) {
  Contact bond;
  bond.i = i;
  bond.j = j;
  bond.born = step;
  set_geometry(bond, separation, radius_i, radius_j);
  evaluate_loads(bond, law);
  return bond;
}

}  // namespace crumble
