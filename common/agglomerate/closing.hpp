// Closing the contacts of an agglomerate that changed its size or came from elsewhere.
#pragma once

#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/agglomerate/near_pairs.hpp"
#include "common/contact/material.hpp"

namespace crumble {

struct Closed {
  // As given, with moved positions; normals, gaps and normal forces belong to them; histories and other loads are zero.
  // Velocities, forces and torques are dropped: the agglomerate is at rest.
  Frame frame;

  std::vector<NearPair> lost;      // listed pairs that stayed open beyond the pull-off gap: no longer contacts
  std::vector<NearPair> unlisted;  // pairs that overlap now and are not contacts (a contact would form)

  double residual_rms = 0, residual_max = 0;  // |gap - equilibrium gap| over the contacts, m
  double tension_rms = 0;                     // rms normal force over the contacts, in F_po of each pair
  double tension_max = 0;                     // largest tension, in F_po (0 if there is none)
  double compression_max = 0;                 // largest compression, in F_po, positive
  double largest_move = 0;                    // farthest that a particle was moved, m
  int iterations = 0;
  bool converged = false;  // the residual is at round-off, or no short move lessens it by much
};

// Moves the particles until every listed pair has the gap at which its JKR force is zero:
//     |x_j - x_i| = a_i + a_j + h_eq(i, j)
// by the least-squares projection of projection.hpp. Trees and every network without redundant contacts are closed to
// round-off. In a hyperstatic one what remains is self-stress, and is reported. A contact that even so is open beyond
// the gap where JKR ends cannot exist: the most open one of its neighbourhood is dropped and the rest closed again,
// until none is. The centre of the positions stays. Throws std::invalid_argument for wrong indices, repeated pairs and
// coincident centres, naming them.
Closed close_contacts(const Particles& particles, const Frame& frame, const Material& material);

// The same, and pairs that come to overlap without being listed are contacts too: closing goes on with them in the list
// until none is left out (`unlisted` is empty then), for at most ten rounds. A dense agglomerate whose contacts were
// deeper than those of the new radius closes onto such pairs; left alone they would start with tens of pull-off forces
// of compression. `made` is set to their number.
Closed close_all_contacts(const Particles& particles, const Frame& frame, const Material& material, std::size_t& made);

}  // namespace crumble
