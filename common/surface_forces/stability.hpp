// What the forces between two equal spheres mean for a suspension: barrier, stability ratio, secondary minimum.
#pragma once

#include <functional>
#include <optional>

namespace crumble {

using GapFunction = std::function<double(double)>;  // of the gap, m

// Extremes of an energy U(h) between two gaps, found on a grid that is even in ln h and refined: gap m, value as U.
struct Extreme {
  double gap, value;
};
std::optional<Extreme> barrier(const GapFunction& energy, double from, double to);
// The minimum outside `from`; nothing where the energy only falls towards it.
std::optional<Extreme> outer_minimum(const GapFunction& energy, double from, double to);

// By how much slower two spheres of radius a meet than without repulsion, W = integral with U over that with U0:
//   W = int beta e^(U/kT)/(h + 2 a)^2 dh / int beta e^(U0/kT)/(h + 2 a)^2 dh,   from h = 0 to infinity
// beta = 1 where spheres do not feel each other's flow (free draining), else
//   beta = (6 u^2 + 13 u + 2)/(6 u^2 + 4 u),  u = h/a
// Source: Fuchs 1934, Z. Phys. 89, 736; attraction without repulsion as the reference: McGown & Parfitt 1967; beta:
// Honig, Roebersen & Wiersema 1971, J. Colloid Interface Sci. 36, 97, after Spielman 1970. Result: ln W, since W itself
// soon exceeds any number. Sums by the trapezoidal rule, even in ln h from 1e-7 a to 1e4 a; beta needs an energy that
// falls without limit at contact, as Hamaker's does.
enum class Drainage { free, lubricated };
double log_stability_ratio(const GapFunction& energy_over_kT, const GapFunction& attraction_over_kT, double a,
                           Drainage drainage);
double squeezing_resistance(double gap, double a);  // beta

// Time in which half of the particles of a volume fraction phi meet another when all meetings last, s:
//   t = pi mu a^3/(phi kT)
// Source: Smoluchowski 1917, rate 8 kT/(3 mu) for equal spheres. Without attraction before contact.
double rapid_coagulation_half_time(double viscosity, double a, double volume_fraction, double thermal_energy);

}  // namespace crumble
