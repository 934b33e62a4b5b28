#include "common/io/output_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "common/io/file_errors.hpp"

namespace crumble {
namespace {

// The 22nd word of /proc/PID/stat; the second is a name in brackets that may hold anything.
std::string start_of(long process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  std::size_t at = all.rfind(')');
  for (int word = 2; word < 22 && at != all.npos; ++word) at = all.find(' ', at + 1);
  return at == all.npos ? "" : all.substr(at + 1, all.find(' ', at + 1) - at - 1);
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

// Whether a lock on this file system is seen by all that mount it. That of a disk of this machine is; those of networks
// are if the options of the mount say so.
bool reaches_all_hosts(int descriptor) {
  constexpr std::array<std::string_view, 9> networks{"nfs",  "nfs4",   "cifs",   "smb3", "9p",
                                                     "fuse", "lustre", "beegfs", "afs"};
  struct stat about {};
  if (fstat(descriptor, &about) != 0) return false;
  const std::string device = fmt::format(" {}:{} ", major(about.st_dev), minor(about.st_dev));
  std::ifstream mounts("/proc/self/mountinfo");
  for (std::string line; std::getline(mounts, line);) {
    const auto end = line.find(" - ");
    if (line.find(device) == line.npos || end == line.npos) continue;
    const std::string type = line.substr(end + 3, line.find_first_of(" .", end + 3) - end - 3);
    if (std::find(networks.begin(), networks.end(), type) == networks.end()) return true;
    return line.find("local_lock=none", end) != line.npos || line.find(",flock", end) != line.npos;
  }
  return true;
}

std::string content_of(int descriptor) {
  std::array<char, 1024> block{};
  const auto count = pread(descriptor, block.data(), block.size(), 0);
  return {block.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

bool is_the_file(int descriptor, const std::filesystem::path& name) {
  struct stat ours {
  }, there{};
  return fstat(descriptor, &ours) == 0 && stat(name.c_str(), &there) == 0 && ours.st_dev == there.st_dev &&
         ours.st_ino == there.st_ino;
}

// The error, or 0.
int write_anew(int descriptor, const std::string& text) {
  if (ftruncate(descriptor, 0) != 0) return errno;
  for (std::size_t done = 0; done < text.size();) {
    const auto count = pwrite(descriptor, text.data() + done, text.size() - done, static_cast<off_t>(done));
    if (count < 0 && errno != EINTR) return errno;
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  return 0;
}

std::string reason(int error) { return std::generic_category().message(error); }

}  // namespace

LockOwner LockOwner::of_this_process() {
  const long process = getpid();
  return {process, host_name(), fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))),
          start_of(process)};
}

std::string LockOwner::text() const {
  return fmt::format("process {} on {} since {} (start {})\n", process, host, since, start);
}

std::optional<LockOwner> LockOwner::from_text(std::string_view text) {
  std::array<std::string_view, 8> words;
  for (auto& word : words) {
    const auto end = text.find_first_of(" \n");
    if (end == text.npos) return std::nullopt;
    word = text.substr(0, end);
    text.remove_prefix(end + 1);
  }
  LockOwner owner{0, std::string(words[3]), std::string(words[5]), std::string(words[7].substr(0, words[7].find(')')))};
  const auto [end, problem] = std::from_chars(words[1].data(), words[1].data() + words[1].size(), owner.process);
  const bool ours = words[0] == "process" && words[2] == "on" && words[4] == "since" && words[6] == "(start";
  return problem == std::errc() && ours ? std::optional(owner) : std::nullopt;
}

std::optional<bool> LockOwner::is_alive() const {
  if (host != host_name()) return std::nullopt;
  if (kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH) return false;
  return start == start_of(process);
}

OutputLock::OutputLock(const std::filesystem::path& output) {
  if (is_stream(output)) return;
  const std::filesystem::path place = followed(output);
  file_ = place.string() + ".lock";
  const auto refuse = [&](const std::string& what) {
    if (descriptor_ >= 0) close(descriptor_);
    throw OpenError(fmt::format("{}: {}", output.string(), what));
  };
  const auto refuse_held = [&](const std::optional<LockOwner>& owner, const std::string& remedy) {
    const std::string who =
        owner ? fmt::format("process {} on {} since {}", owner->process, owner->host, owner->since) : "another run";
    refuse(fmt::format("is being written by {}; {}", who, remedy));
  };
  for (;;) {
    constexpr int how = O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW;
    descriptor_ = open(file_.c_str(), how | O_EXCL, 0666);
    const bool is_new = descriptor_ >= 0;
    if (!is_new && errno == EEXIST) descriptor_ = open(file_.c_str(), how, 0666);
    if (descriptor_ < 0) refuse("cannot be written: " + file_.string() + ": " + reason(errno));
    struct stat about {};
    if (fstat(descriptor_, &about) != 0 || !S_ISREG(about.st_mode))
      refuse("cannot be written: " + file_.string() + " is not a file");
    const bool locked = flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    const int error = locked ? 0 : errno;
    const auto owner = LockOwner::from_text(content_of(descriptor_));
    if (error == EWOULDBLOCK) refuse_held(owner, "wait for it, end it, or write elsewhere");
    if (locked && !is_the_file(descriptor_, file_)) {  // its owner ended, and removed it, in between
      close(descriptor_);
      continue;
    }
    // A lock that was to be had proves that its owner is dead, unless it is one that does not reach other machines. A
    // file without an owner may be one that is just being made.
    const bool proves = locked && reaches_all_hosts(descriptor_);
    if (!is_new && !proves && (owner ? owner->is_alive().value_or(true) : !locked))
      refuse_held(owner, fmt::format("if that run has ended, remove {}", file_.string()));
    break;
  }
  removed_ = std::make_unique<RemovedAtSuddenEnd>(file_);
  const std::string text = LockOwner::of_this_process().text();
  if (const int error = write_anew(descriptor_, text)) {
    unlink(file_.c_str());
    refuse("cannot be written: " + file_.string() + ": " + reason(error));
  }
}

OutputLock::OutputLock(OutputLock&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      removed_(std::move(other.removed_)) {}

OutputLock::~OutputLock() {
  if (descriptor_ < 0) return;
  if (is_the_file(descriptor_, file_)) unlink(file_.c_str());  // while it is still locked
  close(descriptor_);
}

OwnedOutputs::OwnedOutputs(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read) {
  require_separate(written, read);
  for (const WrittenFile& file : written) locks_.emplace_back(file.name);
}

}  // namespace crumble
