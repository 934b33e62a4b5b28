// One run owns an output.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/output_file.hpp"

namespace crumble {

// Who has taken an output, as the lock file says it.
struct LockOwner {
  long process = 0;
  std::string host, since;  // since: UTC
  std::string start;        // of the process, as the kernel counts it: a number may be given out again

  static LockOwner of_this_process();
  static std::optional<LockOwner> from_text(std::string_view text);
  std::string text() const;
  // Nothing if that cannot be seen from here: the process is of another host.
  std::optional<bool> is_alive() const;
};

// Taken before the output or anything beside it is opened, and kept to the end: the kernel's own lock (flock) on
// OUTPUT.lock, which ends with its owner however that dies. A file that a killed run left behind is taken over. Where
// the file system has no such lock, or does not carry it to other machines, what the file says about its owner counts.
class OutputLock {
 public:
  // Throws InputError saying who holds it, or why nothing can be written there. A stream needs no lock.
  explicit OutputLock(const std::filesystem::path& output);
  ~OutputLock();  // removes the lock file
  OutputLock(OutputLock&& other) noexcept;
  OutputLock& operator=(OutputLock&&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::unique_ptr<RemovedAtSuddenEnd> removed_;
};

// All that a program writes is its own as long as this lives.
class OwnedOutputs {
 public:
  // Throws InputError if one of them cannot be written, would overwrite what is read, or is being written by another.
  OwnedOutputs(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read);

 private:
  std::vector<OutputLock> locks_;
};

}  // namespace crumble
