// Fragments: the connected pieces of the contact network.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble {

// The fragment of every particle, numbered from 0 = the one with most particles; of two equally large ones the one
// that holds the smaller particle index comes first. A particle without contacts is a fragment of its own.
std::vector<std::int32_t> fragments(std::size_t particle_count, std::span<const Contact> contacts);

// Number of particles in each fragment, descending, from the labels above.
std::vector<std::int64_t> fragment_sizes(std::span<const std::int32_t> fragment);

// The largest fragment alone, its particles and contacts renumbered in order.
Agglomerate largest_fragment(const Agglomerate& agglomerate);

}  // namespace crumble
