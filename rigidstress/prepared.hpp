// The agglomerate as it is analysed: at the scene's size, with closed contacts, divided into bodies.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/agglomerate/closing.hpp"
#include "common/rigid/network.hpp"
#include "common/surface_forces/surface_forces.hpp"

namespace crumble::rigidstress {

struct Prepared {
  Particles particles;
  Frame frame;                                // contacts closed to the JKR equilibrium gap; what the file keeps
  std::vector<Vector3> position;              // where the analysis has the spheres: contacts at gap zero, see below
  double scale = 1;                           // new over old radius
  std::vector<NearPair> lost;                 // of the closing
  std::size_t made = 0;                       // pairs that it brought to overlap: contacts, too
  double residual_rms = 0, residual_max = 0;  // tension that closing left, N
  double largest_tension = 0;                 // the same, in pull-off forces
};

// Scales the agglomerate to `radius` (mean; without it it keeps its own) and closes its contacts.
//
// A JKR contact at rest overlaps by (2/3) b0^2/a, 0.2 % of a at 100 nm, since the spheres are flattened there. A rigid
// analysis of spheres wants them to touch: `position` is the closed configuration stretched by that amount, the mean of
// (a_i + a_j)/(distance) over the contacts, so that results do not depend on the material through it.
//
// only_largest: leaves the other pieces out. Throws InputError, naming the pair, where a listed contact is open by more
// than `largest_gap` radii. Throws std::runtime_error if closing does not converge.
Prepared prepare(const Agglomerate& agglomerate, const std::string& name, std::optional<double> radius,
                 const Material& material, double largest_gap, bool only_largest = false);

// Positions of closed contacts stretched to gap zero.
std::vector<Vector3> touching_positions(const Particles& particles, const Frame& frame);

// One connected part.
struct Body {
  std::vector<int> particle;  // rows of the particle arrays, ascending
  std::vector<int> contact;   // rows of the contact list
};
std::vector<Body> bodies(const Prepared& prepared);  // as fragments: largest first

// Joints in the order of body.contact, numbered within the body.
Network network_of(const Prepared& prepared, const Body& body, const JointChoice& choice, const Material& material);

Vector3 centre_of(const Prepared& prepared, const Body& body);  // centre of mass of `position`, m
// Of each contact, N; in a liquid with surface forces less by what its double layers repel at pull-off.
std::vector<double> pull_off_of(const Prepared& prepared, const Body& body, const Material& material,
                                const std::optional<SurfaceForces>& surface_forces);

}  // namespace crumble::rigidstress
