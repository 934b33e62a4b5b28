#include "common/tool/frames.hpp"

#include <fmt/format.h>

#include <numeric>

#include "common/io/errors.hpp"

namespace crumble::tool {

std::vector<std::size_t> chosen_frames(const FrameChoice& choice, std::size_t frame_count, const std::string& file) {
  if (choice.kind == FrameChoice::Kind::all) {
    std::vector<std::size_t> all(frame_count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  if (choice.kind == FrameChoice::Kind::last) return {frame_count - 1};
  if (choice.number >= frame_count) {
    throw InputError(fmt::format("agglomerate: {}: --frame {}: the file has the frames 0 to {}", file, choice.number,
                                 frame_count - 1));
  }
  return {choice.number};
}

}  // namespace crumble::tool
