// Adhesive elastic contact of two spheres after Johnson, Kendall & Roberts.
#pragma once

#include "common/contact/material.hpp"

namespace crumble {

// Pull-off force of a pair, the largest tension that it bears.
//   F_po = (3/2) pi gamma_s a                                       (paper, Eq. 6)
// Source: Johnson, Kendall & Roberts 1971, F_po = (3/2) pi w R* with w = 2 gamma_s and R* = a/2.
// a: pair_radius, m; gamma_s: J/m^2; result: N, positive.
double pull_off_force(const Material& material, double pair_radius);

// The normal law of one pair, with its constants computed once.
//
//   h = (b0^2/a) ((1 + s)/2)^(1/3) (1 - 3 s)/3,   N = F_po (1 - s^2),   s >= 0        (paper, Eq. 10)
//
// Eq. 10 counts the force positive in compression; here tension N is positive, so s = sqrt(1 - N/F_po). The printed b0
// lacks its cube root. With c = ((1 + s)/2)^(1/3), which is sqrt(contact radius / b0), the branch is a polynomial:
//
//   h = (b0^2/a) (4 c - 6 c^4)/3,   N = 4 F_po (c^3 - c^6),   c >= 2^(-1/3)
//
// Units: h m (gap > 0: surfaces apart), N N. Zero force at h = equilibrium_gap < 0. A contact persists up to
// pull_off_gap > 0, where N = F_po, and is lost beyond; it is made (again) at h = 0, where N = (8/9) F_po: hysteresis.
struct Jkr {
  double pull_off_force = 0;    // F_po, N
  double zero_load_radius = 0;  // b0 = [9 pi gamma_s a^2 (1 - nu^2)/(2 E)]^(1/3), m
  double length = 0;            // b0^2/a, m
  double equilibrium_gap = 0;   // -(2/3) b0^2/a, m
  double pull_off_gap = 0;      // h_po = [3 pi^2 gamma_s^2 a (1 - nu^2)^2/(8 E^2)]^(1/3), m  (paper, Eq. 11)

  Jkr() = default;
  Jkr(const Material& material, double pair_radius);

  struct State {
    double tension;    // N, N; the limit F_po for gaps beyond pull_off_gap
    double stiffness;  // dN/dh >= 0, N/m; 0 beyond pull_off_gap
  };
  State state(double gap) const;
  double tension(double gap) const { return state(gap).tension; }

  // Gap under a given tension <= F_po: Eq. 10 itself.
  double gap(double tension) const;

  // Work of stretching from the equilibrium gap to `gap`, J; constant beyond pull_off_gap. tension = d(energy)/d(gap).
  double energy(double gap) const;

  // k_n = (9/5) a F_po/b0^2 = (3/5) E b0/(1 - nu^2): dN/dh at zero force, N/m.
  double tangent_stiffness() const { return 1.8 * pull_off_force / length; }

  // F_po/(h_po - h_eq): mean stiffness from zero force to rupture, N/m.
  double secant_stiffness() const { return pull_off_force / (pull_off_gap - equilibrium_gap); }

 private:
  double root(double gap) const;
};

}  // namespace crumble
