// The smallest eddies of a turbulent liquid: what a granule much smaller than they are feels is a linear flow.
#pragma once

#include <cmath>

namespace crumble {

// Root mean square of the shear rate sqrt(2 E:E) in homogeneous turbulence, 1/s:
//   gamma_dot = sqrt(epsilon/nu),   exact, since epsilon = 2 nu <E:E>
// Local values scatter: rare ones are several times as large. Source: Tennekes & Lumley 1972, 3.2; Saffman & Turner
// 1956. dissipation: epsilon, W/kg; kinematic_viscosity: nu, m^2/s.
inline double kolmogorov_shear_rate(double dissipation, double kinematic_viscosity) {
  return std::sqrt(dissipation / kinematic_viscosity);
}

// Kolmogorov length (nu^3/epsilon)^(1/4), m: the smallest eddies are some ten of it.
inline double kolmogorov_length(double dissipation, double kinematic_viscosity) {
  return std::pow(kinematic_viscosity * kinematic_viscosity * kinematic_viscosity / dissipation, 0.25);
}

}  // namespace crumble
