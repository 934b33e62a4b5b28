#include "common/rigid/joint.hpp"

#include "common/contact/jkr.hpp"
#include "common/contact/rolling.hpp"
#include "common/contact/sliding.hpp"
#include "common/contact/twisting.hpp"

namespace crumble {

Joint make_joint(const JointChoice& choice, const Material& material, int i, int j, double radius_i, double radius_j) {
  const double a = pair_radius(radius_i, radius_j);
  const Jkr jkr(material, a);
  Joint joint;
  joint.i = i;
  joint.j = j;
  joint.normal = choice.normal == NormalStiffness::tangent ? jkr.tangent_stiffness() : jkr.secant_stiffness();
  joint.sliding = sliding_stiffness(material, a);
  joint.twisting = choice.twisting_factor * twisting_stiffness(material, a);
  joint.bending = choice.bending_factor * rolling_stiffness(material, a);
  return joint;
}

}  // namespace crumble
