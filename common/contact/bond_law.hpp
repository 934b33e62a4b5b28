// All laws of one bonded pair together: what a time loop asks of a contact.
#pragma once

#include "common/contact/cundall_strack.hpp"
#include "common/contact/jkr.hpp"
#include "common/contact/material.hpp"

namespace crumble {

enum class NormalLaw { jkr, cundall_strack };

// What a scene may choose. A limit factor multiplies the critical load of Eqs. 14, 17, 21: 0 takes the resistance away,
// infinity makes it elastic without limit.
struct ContactChoice {
  NormalLaw normal = NormalLaw::jkr;
  double stiffness_factor = 1;  // cundall_strack only: k = factor E a
  double friction = 0.5;        // cundall_strack only
  double sliding_limit_factor = 1;
  double twisting_limit_factor = 1;
  double rolling_limit_factor = 1;
  double rolling_stiffness_factor = 1;  // of Eq. 20; the critical torque of Eq. 21 stays
};

struct BondLaw {
  NormalLaw kind = NormalLaw::jkr;
  Jkr jkr;
  CundallStrack linear;
  double k_s = 0, k_t = 0, k_r = 0;                 // N/m, N m/rad, N m/rad; 0: no such resistance
  double F_s_crit = 0, M_t_crit = 0, M_r_crit = 0;  // N, N m, N m

  BondLaw() = default;
  BondLaw(const ContactChoice& choice, const Material& material, double radius_i, double radius_j);

  Jkr::State normal(double gap) const {
    if (kind == NormalLaw::jkr) return jkr.state(gap);
    return gap > linear.pull_off_gap() ? Jkr::State{linear.pull_off_force, 0}
                                       : Jkr::State{linear.tension(gap), linear.stiffness};
  }
  // Potential of the normal force, J, up to a constant.
  double normal_energy(double gap) const;
  // A bond is lost beyond this gap, m.
  double lost_gap() const { return kind == NormalLaw::jkr ? jkr.pull_off_gap : linear.pull_off_gap(); }
  double pull_off_force() const { return kind == NormalLaw::jkr ? jkr.pull_off_force : linear.pull_off_force; }
  double equilibrium_gap() const { return kind == NormalLaw::jkr ? jkr.equilibrium_gap : 0; }
  double normal_stiffness() const { return kind == NormalLaw::jkr ? jkr.tangent_stiffness() : linear.stiffness; }
  // Largest sliding force under a given normal tension, N.
  double sliding_limit(double tension) const {
    return kind == NormalLaw::jkr || k_s == 0 ? F_s_crit : linear.sliding_limit(tension);
  }
};

}  // namespace crumble
