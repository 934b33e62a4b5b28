// [surface_forces] of the scenes: declared once, read, checked and told to people the same way in every program.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/contact/bond_law.hpp"
#include "common/io/parameters.hpp"
#include "common/io/report.hpp"
#include "common/surface_forces/surface_forces.hpp"

namespace crumble {

Section surface_forces_section();

// Nothing where the scene has no such table. temperature: of the liquid, K. Throws InputError naming file, line and
// keys where values contradict each other, look like another unit, or lie where a law does not hold; radii of the
// smallest and largest particle, m.
std::optional<SurfaceForces> surface_forces_in(const Scene& scene, double temperature);
void check_surface_forces(const Scene& scene, const SurfaceForces& forces, const Material& material, double smallest,
                          double largest);

// gamma_s of the Hamaker constant, if the scene asks for it, else as it is. J/m^2.
void take_surface_energy(const Scene& scene, Material& material);

// What two equal particles of radius a in this liquid come to.
struct PairOutlook {
  double ionic_strength = 0, debye_length = 0, kappa_a = 0, potential = 0;  // mol/m^3, m, -, V
  std::optional<double> barrier, barrier_gap;                               // kT, m
  double largest_repulsion = 0;                                             // N
  std::optional<double> well, well_gap;                                     // secondary minimum: kT (negative), m
  double log_W_free = 0, log_W_lubricated = 0;
  double pull_off_force = 0, pull_off_force_in_liquid = 0;  // N
  double joined_gap = 0, joined_step = 0, range = 0;        // m, N, m
};
PairOutlook outlook(const SurfaceForces& forces, const ContactChoice& contact, const Material& material, double a,
                    double ionic_strength);

// For people, a line each; name: "at the start". For the report, in a group.
std::vector<std::string> describe(const PairOutlook& outlook, const std::string& name);
void report_outlook(Report& report, const std::string& group, const PairOutlook& outlook);

}  // namespace crumble
