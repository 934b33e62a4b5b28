// How a droplet is filled at the start.
#pragma once

#include "common/agglomerate/agglomerate.hpp"

namespace crumble::dryer {

// Particles of given radii (m) and density (kg/m^3), numbered from 0.
Particles suspended_particles(const std::vector<double>& radius, double density);

// These, uniform, non-overlapping and fully immersed in a droplet of radius R0 (r + a <= R0), by random sequential
// addition: each particle draws positions, keyed by (seed, particle, attempt), until one is free. The first particles
// are the same for any larger N. Throws std::runtime_error naming the particle if none is free after 100000 draws.
Agglomerate random_suspension(const std::vector<double>& radius, double density, double droplet_radius,
                              std::uint64_t seed);

}  // namespace crumble::dryer
