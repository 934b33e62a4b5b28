// Elastic, perfectly plastic spring: what sliding, twisting and rolling have in common.
#pragma once

#include <cmath>

namespace crumble {

// F = -k xi with |F| <= F_crit; beyond, the stored displacement is reset so that k |xi| = F_crit:
//   xi <- xi F_crit/(k |xi|)
//   sliding force    F_s = min(k_s |int u_s dt|, F_s^crit)                                (paper, Eq. 12)
//   twisting torque  M_t = min(k_t |int W_t dt|, M_t^crit)                                (paper, Eq. 15)
//   rolling torque   M_r = min(k_r |int u_r dt|, M_r^crit), u_r as a relative angle       (paper, Eq. 19)
// The cap acts on the magnitude. Without the reset the spring would wind up and push back long after a reversal.
// Source: Marshall 2009. Displacement: double or Vector3, m or rad; stiffness k >= 0; limit F_crit >= 0, may be
// infinite. True if the spring yielded.
inline double spring_norm(double x) { return std::abs(x); }
template <class V>
double spring_norm(const V& x) {
  return x.norm();
}

template <class Displacement>
bool yield(Displacement& displacement, double stiffness, double limit) {
  const double force = stiffness * spring_norm(displacement);
  if (!(force > limit)) return false;
  displacement *= limit / force;
  return true;
}

// Energy whose gradient is the capped force: k xi^2/2 up to the limit and a straight line beyond. The minimum of a sum
// of such energies is an implicit step of the plastic springs (return mapping).
inline double capped_energy(double displacement, double stiffness, double limit) {
  const double force = stiffness * displacement;
  return force <= limit ? 0.5 * force * displacement : limit * (displacement - 0.5 * limit / stiffness);
}

}  // namespace crumble
