// The salt in the liquid.
#pragma once

namespace crumble {

inline constexpr double elementary_charge = 1.602176634e-19;     // e, C, exact (SI 2019)
inline constexpr double avogadro_constant = 6.02214076e23;       // 1/mol, exact (SI 2019)
inline constexpr double vacuum_permittivity = 8.8541878128e-12;  // F/m

// What screens charges: ions of valence 1 in a liquid of permittivity eps.
struct Electrolyte {
  double ionic_strength = 0;  // I, mol/m^3 (that is mmol/l)
  double permittivity = 0;    // eps, F/m
  double thermal_energy = 0;  // kT, J

  // kappa = sqrt(2 N_A e^2 I/(eps kT)), 1/m: inverse Debye length. In water at 25 C 0.304 nm/sqrt(I/(mol/l)).
  // Source: Debye & Hueckel 1923.
  double inverse_debye_length() const;
  // kT/e, V: the unit in which potentials are counted.
  double thermal_voltage() const { return thermal_energy / elementary_charge; }
};

// Salt stays in the liquid: I = I0 V0/V. Volumes of the liquid alone, m^3; what exceeds `solubility` has crystallised.
double concentrated(double ionic_strength, double volume_before, double volume, double solubility);

}  // namespace crumble
