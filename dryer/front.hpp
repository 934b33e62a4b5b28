// The receding surface in time: Eq. 7, slowed where a dry crust hinders the vapour.
#pragma once

#include "common/agglomerate/agglomerate.hpp"
#include "common/numerics/saved_fields.hpp"
#include "dryer/droplet.hpp"

namespace crumble::dryer {

// Rate of evaporation behind a dry crust in that of the free droplet of the same radius R. Vapour diffuses through
// still gas outside R_p and through the pores of the crust between R and R_p, where its diffusivity is `relative` times
// that in the gas; the two resistances stand in series, 1/R_p and (1/relative)(1/R - 1/R_p), against 1/R without a
// crust:
//   k_eff/k = 1/(1 + c (1/relative - 1) (1 - R/R_p))
// c is the share of directions in which there is crust: 1 is the closed crust of the source. Source: shrinking wet
// core, Nesic & Vodnik 1991; Mezhericher, Levy & Borde 2007. relative: porosity over tortuosity, 0 to 1; result:
// relative to 1.
inline double crust_hindrance(double relative, double covered, double R, double R_p) {
  return 1 / (1 + covered * (1 / relative - 1) * (1 - R / R_p));
}

// What the liquid has left dry: particles whose centres lie beyond the surface.
struct DryCrust {
  double covered = 0;  // share of all directions, sum a^2/(4 r^2), not above 1
  double reach = 0;    // R_p, mean of r + a, each particle with the directions that it covers, m
};
DryCrust dry_crust(const Particles& particles, const Frame& frame, double R);

// R(t). The hindrance is taken at the end of every step and stands until the end of the next, so R^2 falls linearly in
// time within a step and nothing depends on chance. Without hindrance (relative diffusivity 1) this is Eq. 7 to the
// bit.
class Front {
 public:
  Front(const Droplet& droplet, double relative_diffusivity) : droplet_(droplet), relative_(relative_diffusivity) {}

  // Out of line, both: inlined where the droplet may or may not follow a curve, the compiler rounds Eq. 7 otherwise.
  double radius(double time) const;
  // Instants at which the front is at R and at which the liquid is gone, as things stand, s.
  double time_at(double R) const;
  double end() const { return time_of(droplet_.lifetime); }

  // Time for which a droplet without a crust would have dried so far, s, and when it will have dried for `reduced`.
  double reduced(double time) const { return past_.reduced + past_.rate * (time - past_.time); }
  double time_of(double reduced) const { return past_.time + (reduced - past_.reduced) / past_.rate; }

  bool may_slow_down() const { return relative_ < 1; }
  void follow(const Agglomerate& state);

  void fields(SavedFields& f);

 private:
  // Since `time` the front has been where Eq. 7 has it at `reduced`, and `rate` times as fast.
  struct Past {
    double time = 0, reduced = 0, rate = 1;  // s, s, -
  };

  const Droplet& droplet_;
  double relative_;
  Past past_;
};

}  // namespace crumble::dryer
