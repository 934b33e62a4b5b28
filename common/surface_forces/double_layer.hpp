// Screened electrostatic repulsion of two spheres.
#pragma once

#include "common/surface_forces/electrolyte.hpp"

namespace crumble {

// Potential, in kT/e, that a sphere of a small charge would need to be seen from far away like one of the potential
// psi:
//   Y = 8 g/(1 + sqrt(1 - (2 kappa a + 1) g^2/(kappa a + 1)^2)),  g = tanh(e psi/(4 kT))
// so that the potential outside is (kT/e) Y (a/r) exp(-kappa (r - a)) far from the surface. kappa a -> infinity: 4 g;
// small psi: e psi/kT. Source: Ohshima, Healy & White 1982, J. Colloid Interface Sci. 90, 17. a: m, psi: V.
double effective_potential(const Electrolyte& electrolyte, double a, double potential);

// Energy of two spheres by linear superposition of their double layers, any kappa a:
//   V_R = 4 pi eps (kT/e)^2 Y1 Y2 (a1 a2/r) exp(-kappa h),  r = a1 + a2 + h
// Exact for h >> 1/kappa, where neither surface regulates the other; nearer it lies between constant potential and
// constant charge, which differ there. kappa a -> infinity: 32 pi eps a (kT/e)^2 g^2 exp(-kappa h) for equal spheres.
// Source: Bell, Levine & McCartney 1970, J. Colloid Interface Sci. 33, 335; with Y of Ohshima, Healy & White 1982.
// Across a contact (h < 0), where there is no liquid left to screen anything, the push of h = 0 goes on: the form
// itself would grow exponentially with the overlap of two spheres that in truth are flattened.
struct DoubleLayer {
  double strength = 0;  // 4 pi eps (kT/e)^2 Y1 Y2 a1 a2, J m
  double distance = 0;  // a1 + a2, m
  double kappa = 0;     // 1/m

  double energy(double gap) const;     // J
  double tension(double gap) const;    // dV_R/dh, N: negative, repulsion
  double stiffness(double gap) const;  // d^2V_R/dh^2 for h >= 0, N/m

 private:
  double plain_energy(double gap) const;
};
// Radii a1, a2: m; effective potentials Y1, Y2: kT/e.
DoubleLayer double_layer(const Electrolyte& electrolyte, double a1, double a2, double effective_1, double effective_2);

// Ionic strength at which barrier and force at the barrier vanish together, mol/m^3, by h << a and kappa a >> 1:
//   kappa_c = 384 pi eps (kT/e)^2 g^2/(exp(1) A)
// from V_A = -A a/(12 h) and V_R = 32 pi eps a (kT/e)^2 g^2 exp(-kappa h) at h = 1/kappa. Source: Derjaguin & Landau
// 1941; Verwey & Overbeek 1948. The electrolyte's own ionic strength does not matter. potential: V; A: J.
double critical_coagulation_concentration(const Electrolyte& electrolyte, double potential, double hamaker);

}  // namespace crumble
