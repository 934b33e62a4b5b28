// Whether thermal motion breaks bonds while a droplet dries: what decides how they are integrated.
#pragma once

#include "dryer/scene.hpp"

namespace crumble::dryer {

struct ThermalRupture {
  double bond = 0;  // work that breaks the weakest bond, in kT
  double most = 0;  // bonds that thermal motion breaks in all of the drying, at most
  // Then no bond breaks but under load.
  bool never() const { return most < 0.01; }
};

// `most` is Arrhenius' rate without any prefactor below one attempt in each relaxation time of the bond,
//   3 N (tau/epsilon) k_n/zeta exp(-W/kT)
// with three bonds a particle, W from the law of the smallest pair, and tau/epsilon the longest that drying may take
// behind its crust. Kramers' prefactor is smaller. N: number of particles; only with Brownian motion and the JKR law.
ThermalRupture thermal_rupture(const DryingModel& model, double number, double smallest_radius);
inline ThermalRupture thermal_rupture(const DryingScene& s) {
  return thermal_rupture(s.model, static_cast<double>(s.radius.size()), s.smallest_radius());
}

}  // namespace crumble::dryer
