// Which frames of a file the command line means.
#pragma once

#include <string>
#include <vector>

#include "common/tool/options.hpp"

namespace crumble::tool {

// Numbers of the frames, ascending. Throws InputError if the file has no such frame.
std::vector<std::size_t> chosen_frames(const FrameChoice& choice, std::size_t frame_count, const std::string& file);

}  // namespace crumble::tool
