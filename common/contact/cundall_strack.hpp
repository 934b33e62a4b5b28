// Linear contact with Coulomb friction and a constant pull-off force.
#pragma once

namespace crumble {

// Normal force of the cohesive Cundall & Strack (1979) contact as the paper used it in its drying runs.
//   N = k h  for h <= F_po/k;  the contact is lost beyond;  it is made at h = 0            (paper, section 2.1)
// The paper gives no stiffness; k = E a is the customary choice of the code it used. k: N/m, h: m, N: N (tension > 0).
struct CundallStrack {
  double stiffness = 0;       // k, N/m
  double pull_off_force = 0;  // F_po of Eq. 6, N
  double friction = 0;        // tangent of the friction angle

  double pull_off_gap() const { return pull_off_force / stiffness; }
  double tension(double gap) const { return stiffness * gap; }

  // Largest sliding force: Coulomb friction on compression plus adhesion, tan(phi) (F_po - N), N; never negative.
  double sliding_limit(double normal_tension) const {
    const double load = pull_off_force - normal_tension;
    return load > 0 ? friction * load : 0;
  }
};

}  // namespace crumble
