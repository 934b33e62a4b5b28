// Which frames of a file the command line means, and files that appear only when they are complete.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "common/tool/options.hpp"

namespace crumble::tool {

// Numbers of the frames, ascending. Throws InputError if the file has no such frame.
std::vector<std::size_t> chosen_frames(const FrameChoice& choice, std::size_t frame_count, const std::string& file);

// A text file under a temporary name until it is finished.
class TextFile {
 public:
  explicit TextFile(std::string name);
  ~TextFile();
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  std::ostream& stream() { return stream_; }
  void finish();  // throws if anything could not be written

 private:
  std::string name_, temporary_;
  std::ofstream stream_;
  bool finished_ = false;
};

}  // namespace crumble::tool
