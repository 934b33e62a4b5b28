// Van der Waals attraction of two spheres.
#pragma once

namespace crumble {

// Energy of two spheres of radii a1, a2 whose centres are r = a1 + a2 + h apart:
//   V_A = -(A/6) [p/s + p/d + ln(s/d)],  p = 2 a1 a2,  s = r^2 - (a1 + a2)^2,  d = r^2 - (a1 - a2)^2
// Source: Hamaker 1937, Physica 4, 1058. For h << a it is -A a1 a2/(6 (a1 + a2) h) (Derjaguin 1934). Its slope has a
// closed form, since p/s^2 + p/d^2 - 1/s + 1/d = p (1/s - 1/d)^2 and d - s = 2 p:
//   dV_A/dh = (4 A/3) p^3 r/(s d)^2
// Retardation: V_A/(1 + 14 h/lambda) (Gregory 1981, J. Colloid Interface Sci. 83, 138, who gives it for h << a; here on
// the whole form).
// A: Hamaker constant across the liquid, J; a1, a2, lambda, h > 0: m; energy J, slope N (positive: attraction).
struct VanDerWaals {
  double hamaker = 0;  // A
  double radius_1 = 0, radius_2 = 0;
  double retardation_rate = 0;  // 14/lambda, 1/m; 0: not retarded

  double energy(double gap) const;
  double tension(double gap) const;  // dV_A/dh
};

// 14/lambda of a wavelength, m; 0 for none.
constexpr double retardation_rate(double wavelength) { return wavelength > 0 ? 14 / wavelength : 0; }

// Surface energy of one surface that van der Waals forces alone give two of them in contact:
//   gamma_s = A/(24 pi D0^2),  D0 = 0.165 nm
// Source: Israelachvili 2011, Intermolecular and Surface Forces, 3rd ed., ch. 13. A: J; result: J/m^2.
inline constexpr double contact_distance = 0.165e-9;  // D0, m
double surface_energy_of(double hamaker);

}  // namespace crumble
