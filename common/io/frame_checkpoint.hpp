// A frame in a checkpoint.
#pragma once

#include "common/agglomerate/agglomerate.hpp"
#include "common/io/checkpoint.hpp"

namespace crumble {

// All of a frame to the bit, the loads of the contacts too, since the next step may start from them. Its arrays are
// called NAME_position, NAME_contacts and so on.
void store_frame(const Frame& frame, const std::string& name, Checkpoint& checkpoint);

// Throws ContentError naming the array if one is missing.
Frame restore_frame(const Checkpoint& checkpoint, const std::string& name);

}  // namespace crumble
