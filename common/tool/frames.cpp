#include "common/tool/frames.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <numeric>
#include <system_error>

#include "common/io/file_errors.hpp"

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

TextFile::TextFile(std::string name) : name_(std::move(name)), temporary_(name_ + ".tmp"), stream_(temporary_) {
  if (!stream_) throw OpenError("agglomerate: " + name_ + ": cannot be created");
}

TextFile::~TextFile() {
  if (finished_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void TextFile::finish() {
  stream_.close();
  if (!stream_) throw WriteError(name_ + ": could not be written completely (disk full?)");
  std::filesystem::rename(temporary_, name_);
  finished_ = true;
}

}  // namespace crumble::tool
