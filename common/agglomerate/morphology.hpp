// Morphology: the numbers by which agglomerates are compared. Pure functions of one configuration.
// Lengths in m, masses in kg (only their ratios matter). Every function throws std::invalid_argument when the spans
// are empty or of different length.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble {

// Arithmetic mean, m; exact where all radii are equal.
double mean_radius(const Particles& particles);

Vector3 centre_of_mass(std::span<const Vector3> position, std::span<const double> mass);

// Distances of the particle centres from the centre of mass, ascending. The k-th (from 1) of N is where the cumulative
// distribution of radial positions (Fig 4 of the paper) steps to k/N.
std::vector<double> radial_positions(std::span<const Vector3> position, std::span<const double> mass);

// Outer and inner radius of an agglomerate, m.
//     outer = mean(r + a) over the 10 % of the particles that reach farthest,
//     inner = mean(r - a) over the 10 % that reach nearest, but not below 0,     r = distance from the centre of mass
//     d_c = 2 outer,  h_c = outer - inner  (crust thickness)
// Source: Vasquez Giuliano et al. 2022, section 3.1, after Jabczynska et al. 2018. The source does not round 10 % of N:
// here the nearest whole number, halves up, and at least one (12 of 115, 9 of 85). It calls h_c/d_c = 0.5 the maximum,
// which holds only with the inner radius floored at 0. For unequal spheres "far" and "near" are judged by r + a and
// r - a, each sphere with its own radius; for equal ones this is the source's choice.
struct RadialExtent {
  double outer = 0, inner = 0;
  double diameter() const { return 2 * outer; }                             // d_c
  double crust_thickness() const { return outer - inner; }                  // h_c
  double relative_crust() const { return crust_thickness() / diameter(); }  // h_c/d_c: 0.5 compact, small hollow
};
RadialExtent radial_extent(std::span<const Vector3> position, std::span<const double> radius,
                           std::span<const double> mass);

// How many particles "10 %" of N are, see above.
std::size_t tenth(std::size_t particle_count);

// R_g = sqrt(sum m r^2 / sum m), the spheres taken as points at their centres (as molecular tools do), m.
double radius_of_gyration(std::span<const Vector3> position, std::span<const double> mass);

// Semi-axes, descending, of the homogeneous ellipsoid with the mass and the inertia tensor of the spheres, m:
//     alpha_k = sqrt(5 lambda_k),  lambda_k eigenvalues of  sum m (x x^T + (a^2/5) 1) / sum m,  x from the centre of
//     mass
// The term a^2/5 is each solid sphere's own inertia (2/5 m a^2 about any diameter); with it one sphere is its own
// ellipsoid and a straight chain keeps a thickness. Leaving it out shortens an axis of 6 a by 1.4 %.
// Source of the idea: Harshe, Ehrl & Lattuada 2010; Sanchez Fellay, Twist & Vanni 2013 (the paper's references 64, 65).
std::array<double, 3> semi_axes(std::span<const Vector3> position, std::span<const double> radius,
                                std::span<const double> mass);

// Void fraction of the sphere of radius `outer` about the centre of mass. A particle that sticks out counts with the
// part inside (sphere-sphere intersection, exact); the overlap of two touching particles (1e-5 of a volume at a JKR
// contact) is not subtracted.
double porosity(std::span<const Vector3> position, std::span<const double> radius, std::span<const double> mass,
                double outer);

// Volume common to two spheres of radii a and b whose centres are d apart, m^3.
double intersection_volume(double a, double b, double d);

// Mean number of contacts a particle has, 2 M / N.
double coordination_number(std::size_t particle_count, std::size_t contact_count);

// Number of contacts of each particle.
std::vector<std::int32_t> coordination(std::size_t particle_count, std::span<const Contact> contacts);

// Pairs with a gap below this fraction of a (2 R* for unequal spheres) count as touching where only positions are
// known.
inline constexpr double touching_fraction = 0.02;

// All of the above for one frame.
struct Morphology {
  std::int64_t particles = 0;
  Vector3 centre = Vector3::Zero();
  RadialExtent extent;
  double radius_of_gyration = 0;
  std::array<double, 3> semi_axes{};
  double porosity = 0;
  std::int64_t contacts = 0;  // bonded pairs: those of the contact list
  std::int64_t touching = 0;  // pairs with gap < touching_fraction * a, bonded or not
  double coordination = 0;    // 2 contacts / particles
  double coordination_touching = 0;
  std::int64_t fragments = 0;
  std::int64_t largest_fragment = 0;  // particles in it
};
Morphology morphology(const Particles& particles, const Frame& frame);

}  // namespace crumble
