// From what a scene says about the process to what the equations need.
#pragma once

#include <memory>
#include <vector>

#include "common/io/machine.hpp"
#include "common/io/parameters.hpp"
#include "dryer/gas/gas_side.hpp"
#include "dryer/liquid_course.hpp"

namespace crumble::dryer {

struct ProcessInputs {
  std::vector<double> radius;          // of the N particles, descending, m
  double viscosity = 0;                // mu, Pa s
  double surface_tension = 0;          // sigma, N/m
  double contact_angle = 0;            // theta, rad
  double thermal_energy = 0;           // kT, J; 0 without Brownian motion
  double lifetime = 0;                 // tau, s
  std::shared_ptr<const GasSide> gas;  // with [gas]
  std::vector<LiquidPiece> liquid;     // its temperature and properties in time, surface tension without contact angle
};

// N is given as such, as a fraction of solids phi = sum a^3/R0^3, or as a fraction of the weight. The speed of drying
// is given as one of
//   tau                                          lifetime
//   k = R0^2/tau,        R^2 = R0^2 - k t        evaporation constant (of the radius squared)    (Eq. 7)
//   v = k/(2 R0)                                 speed of the front at the start                 (Eq. 24)
//   Pe = R0^2/(D tau) = k/D                      Peclet number, D = kT/(6 pi mu a)               (Eqs. 22-23)
// or follows from [gas] (gas/gas_side.hpp); viscosity, surface tension and kT are then those at half of the lifetime.
// Throws InputError naming file, line and keys where they contradict each other, say too little, or cannot be.
// So does a droplet that would need more memory than the machine has.
ProcessInputs process_inputs(const Scene& scene, const Machine& machine);

// All but the particles.
ProcessInputs inputs_without_particles(const Scene& scene);

// Volume fraction of particles of which this is the weight fraction; densities in one unit.
double volume_fraction(double weight_fraction, double particle_density, double liquid_density);

// N of the scene, of distributed radii about; nothing of that size is built.
double particle_number(const Scene& scene);
bool says_number(const Scene& scene);  // or nothing of it

// At the peak of a run, bytes: 1200 a particle, rounded up from the 1,100 of stabilised steps in dryer/NOTEBOOK.md.
double memory_of(double particles);

}  // namespace crumble::dryer
