// A frame among the named fields of a saved state.
#pragma once

#include "common/agglomerate/agglomerate.hpp"
#include "common/numerics/saved_fields.hpp"

namespace crumble {

// All of a frame to the bit, the loads of the contacts too, since the next step may start from them.
void saved_frame(SavedFields f, Frame& frame);

}  // namespace crumble
