// The files that a program writes: where their names lead, and how a file gets its name once it is complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/io/interrupt.hpp"

namespace crumble {

// Where a file of this name stands, or would: links are followed, also one that leads nowhere yet.
std::filesystem::path followed(const std::filesystem::path& name);

// A device, FIFO or socket, or one of the descriptors of this process (/dev/stdout): written to, never replaced.
bool is_stream(const std::filesystem::path& name);

// What a program writes and reads, by what it is called on the command line ("-o", "the scene").
struct WrittenFile {
  std::string what, name;
  bool is_text = false;         // else it must be a file that can be read back
  bool has_checkpoint = false;  // NAME.checkpoint and NAME.frames stand beside it
};
struct ReadFile {
  std::string what, name;
};

// Throws InputError if a file cannot be written where it should be, or if two of all these files, of the temporary and
// lock files that stand beside those written included, are one: compared as files, whatever their spelling.
void require_separate(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read);

// Device and number of the file of this name, by which it is known whatever it is called; zeros if there is none.
std::pair<std::uint64_t, std::uint64_t> file_identity(const std::filesystem::path& name);

// The file of this temporary name is complete and closed. Puts it on the disk and gives it its name, which is on the
// disk too when this returns. Throws WriteError; then the temporary file is still there.
void publish(const std::filesystem::path& temporary, const std::filesystem::path& name);

// A text file that stands under NAME.tmp until it is finished; a stream is written to as it is.
class TextFile {
 public:
  explicit TextFile(const std::filesystem::path& name);  // throws OpenError
  ~TextFile();                                           // removes what is not finished
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  std::ostream& stream() { return stream_; }
  void finish();  // throws WriteError if anything could not be written

 private:
  std::filesystem::path name_, temporary_;  // no temporary: a stream
  std::optional<RemovedAtSuddenEnd> removed_;
  std::unique_ptr<std::streambuf> buffer_;
  std::ostream stream_{nullptr};
  bool finished_ = false;
};

void write_text_file(const std::filesystem::path& name, std::string_view text);

}  // namespace crumble
