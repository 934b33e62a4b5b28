// What thermal motion makes of one JKR bond: how long it lasts and how much it holds a pair together.
#pragma once

#include "common/contact/jkr.hpp"

namespace crumble::dryer {

struct PairStatistics {
  double lifetime;    // mean time from making at h = 0 to loss at h_po, s
  double stickiness;  // bonded probability over the density of pairs just outside, m
  double well;        // the same if detailed balance held from h_po on: integral of exp(-(U - U(h_po))/kT) dh, m
  double rupture;     // U(h_po) - U(h_eq), J
};

// One-dimensional diffusion of the gap in the potential U of the law, from h = 0 until first h_po:
//   lifetime = int_0^h_po dy e^(U(y)/kT) int_-inf^y dx e^(-U(x)/kT)/D        (mean first passage; Kramers 1940)
// Outside, pairs are lost to the bond at h = 0 and come back from it at h_po, so their density falls to zero between;
// balance of the two currents gives stickiness = D lifetime/h_po. The law makes and loses bonds at different gaps, so
// detailed balance does not hold and stickiness < well. thermal_energy kT, J; diffusivity of the gap D = 2 kT/zeta,
// m^2/s. Sums by the trapezoidal rule; relative error below 1e-4.
PairStatistics pair_statistics(const Jkr& law, double thermal_energy, double diffusivity);

// Second virial coefficient over that of hard spheres, narrow well: B2/B2_hs = 1 - 3 stickiness/(2 a).
double second_virial_ratio(double stickiness, double a);

// A material whose JKR bond is `factor` times as wide (h_po, h_eq) and holds a pair as tightly (same stickiness at kT),
// with the same Poisson ratio and density. Its bond is softer and weaker: pull-off force and bond energy fall.
// a: radius of the pair, m. Throws std::invalid_argument if factor < 1 or no such material exists.
Material softened(const Material& material, double a, double thermal_energy, double factor);

}  // namespace crumble::dryer
