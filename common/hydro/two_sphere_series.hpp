// Exact Stokes flow about two rigid spheres in bispherical coordinates: the reference behind the two-sphere table.
#pragma once

#include <array>

#include "common/hydro/two_sphere_real.hpp"
#include "common/hydro/two_sphere_scalars.hpp"

namespace crumble {

// All resistance scalars of sphere 1 (11 and 12) from the flow solved as a series in bispherical harmonics.
//   Method: u = x p/(2 mu) + V with p and V harmonic, each a series in
//   sqrt(cosh zeta - mu) exp(+-(n+1/2) zeta) P_n^m(mu); no-slip gives p and the transverse parts of V locally in terms
//   of V_z, continuity then is a banded linear system in n. Loads are the low multipole moments of p and V.
//   Source of the representation: Stimson & Jeffery 1926 Proc. R. Soc. A 111, 110 (m = 0); Dean & O'Neill 1963
//   Mathematika 10, 13 and O'Neill 1964 Mathematika 11, 67 (m = 1). Strain, stresslet, m = 2: derived here.
//   xi: gap over the mean radius, > 0.  lambda: a2/a1, > 0.  Results in the unit of ResistanceScalars.
// The cost grows as 1/sqrt(xi) (0.04 s at xi = 0.01, seconds at 1e-6): for the generator and for tests, not for stages.
// asymmetry, when given, receives the largest violation of the reciprocal theorem relative to max(|f|, self): an
// error measure, since the loads of a motion and its reciprocal partners come from different sums.
ResistanceScalars two_sphere_series(double xi, double lambda, double* asymmetry = nullptr);

// The same with all its digits, in the order of ResistanceScalars::names, and the scalars of sphere 2, which are those
// of sphere 1 at the ratio 1/lambda.
struct PairSeries {
  std::array<two_sphere::Real, ResistanceScalars::count> one, two;
};
PairSeries two_sphere_series_pair(two_sphere::Real xi, two_sphere::Real lambda, double* asymmetry = nullptr);

}  // namespace crumble
