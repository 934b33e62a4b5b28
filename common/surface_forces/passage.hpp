// How long a pair stays in a well of its energy.
#pragma once

#include "common/surface_forces/stability.hpp"

namespace crumble {

// Mean time in which the gap, diffusing with D in U(h), first reaches `to` from `from`, with a wall at `wall` on the
// other side:
//   T = (1/D) int_from^to dy e^(U(y)/kT) int_wall^y dx e^(-U(x)/kT)      (wall < from < to, or all the other way round)
// Source: Pontryagin, Andronov & Vitt 1933. Narrow gaps: the growth of the sphere r^2 is left out. energy in kT, gaps
// m, D = 2 kT/zeta m^2/s; result s. Trapezoidal rule in even steps.
double mean_first_passage(const GapFunction& energy_over_kT, double wall, double from, double to, double diffusivity);

// Its limit of a high barrier, curvatures U'' at the bottom of the well and on the top, kT/m^2:
//   T = 2 pi e^(U_top - U_bottom)/(D sqrt(U''_bottom |U''_top|))
// to the far side; half of it to the top itself. Source: Kramers 1940, Physica 7, 284.
double kramers_time(double height_over_kT, double curvature_at_bottom, double curvature_on_top, double diffusivity);

}  // namespace crumble
