#include "common/io/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>

#include "common/io/file_errors.hpp"

namespace crumble {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

fs::path folder_of(const fs::path& name) { return name.has_parent_path() ? name.parent_path() : fs::path("."); }

// The number of the descriptor of this process that the name stands for, as /dev/stdout, /dev/fd/3, /proc/self/fd/3.
std::optional<int> descriptor_named(const fs::path& name) {
  std::error_code ignored;
  const fs::path folder = fs::weakly_canonical(folder_of(name), ignored);
  if (folder != fmt::format("/proc/{}/fd", getpid())) return std::nullopt;
  const std::string number = name.filename().string();
  int descriptor = -1;
  const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), descriptor);
  return problem == std::errc() && end == number.data() + number.size() ? std::optional(descriptor) : std::nullopt;
}

// Follows the links of the last part of the name, and stops at a descriptor of this process.
fs::path follow(fs::path name, std::optional<int>& descriptor) {
  constexpr int most = 40;  // as the kernel
  std::error_code problem;
  for (int links = 0; links < most; ++links) {
    descriptor = descriptor_named(name);
    if (descriptor || !fs::is_symlink(fs::symlink_status(name, problem))) return name;
    name = folder_of(name) / fs::read_symlink(name, problem);  // an absolute target replaces the folder
  }
  return name;
}

bool are_one(const fs::path& a, const fs::path& b) {
  std::error_code problem;
  if (fs::equivalent(a, b, problem) && !problem) return true;
  const fs::path first = fs::weakly_canonical(fs::absolute(a, problem), problem);
  return !problem && first == fs::weakly_canonical(fs::absolute(b, problem), problem) && !problem;
}

// All that a program may leave beside a file while it works: those of text have no checkpoint.
std::vector<std::string> endings(const WrittenFile& file) {
  if (file.has_checkpoint) return {"", ".tmp", ".lock", ".frames", ".checkpoint", ".checkpoint.tmp"};
  return {"", ".tmp", ".lock"};
}

void require_writable(const WrittenFile& file) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("{} {}: {}", file.what, file.name, why));
  };
  std::error_code ignored;
  const fs::path place = followed(file.name), folder = folder_of(place);
  if (is_stream(file.name)) {
    if (!file.is_text) refuse("is a device, a pipe or a stream; the result is a file that can be read back");
    if (std::optional<int> number; follow(file.name, number), number && fcntl(*number, F_GETFL) < 0)
      refuse("this stream is closed");
    return;
  }
  if (!fs::is_directory(folder, ignored)) refuse(fmt::format("there is no folder '{}'", folder.string()));
  if (fs::is_directory(place, ignored)) refuse("this is a folder");
  const std::string longest = place.filename().string() + endings(file).back();
  if (const long limit = pathconf(folder.c_str(), _PC_NAME_MAX); limit > 0 && std::ssize(longest) > limit)
    refuse(fmt::format("the name is too long: with '{}' it would have {} bytes, {} are possible here",
                       endings(file).back(), longest.size(), limit));
  if (fs::absolute(place).string().size() + endings(file).back().size() >= PATH_MAX)
    refuse("the name with its folders is too long");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    refuse(fmt::format("the folder '{}' cannot be written to: {}", folder.string(), reason(errno)));
  for (const std::string& ending : endings(file)) {
    const fs::path beside = place.string() + ending;
    const auto there = fs::symlink_status(beside, ignored);
    if (fs::exists(there) && !fs::is_regular_file(there))
      refuse(fmt::format("'{}' is used for writing it, and is there already but not a file", beside.string()));
  }
}

class DescriptorBuffer final : public std::streambuf {
 public:
  explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) { setp(block_.data(), block_.data() + size); }
  ~DescriptorBuffer() override { finish(); }
  DescriptorBuffer(const DescriptorBuffer&) = delete;
  DescriptorBuffer& operator=(const DescriptorBuffer&) = delete;

  // The first error there was, or 0.
  int finish() {
    sync();
    if (const int descriptor = std::exchange(descriptor_, -1); descriptor >= 0 && close(descriptor) != 0 && error_ == 0)
      error_ = errno;
    return error_;
  }

 protected:
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    return traits_type::eq_int_type(c, traits_type::eof()) ? traits_type::not_eof(c)
                                                           : sputc(traits_type::to_char_type(c));
  }
  int sync() override {
    for (const char* at = pbase(); at < pptr() && error_ == 0;) {
      const auto count = ::write(descriptor_, at, static_cast<std::size_t>(pptr() - at));
      if (count < 0 && errno != EINTR) error_ = errno;
      if (count > 0) at += count;
    }
    setp(block_.data(), block_.data() + size);
    return error_ == 0 ? 0 : -1;
  }

 private:
  static constexpr std::size_t size = 1 << 16;
  std::array<char, size> block_;
  int descriptor_, error_ = 0;
};

}  // namespace

fs::path followed(const fs::path& name) {
  std::optional<int> descriptor;
  return follow(name, descriptor);
}

bool is_stream(const fs::path& name) {
  std::optional<int> descriptor;
  std::error_code ignored;
  const auto status = fs::status(follow(name, descriptor), ignored);
  return descriptor || (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status));
}

void require_separate(const std::vector<WrittenFile>& written, const std::vector<ReadFile>& read) {
  for (const WrittenFile& file : written) require_writable(file);
  const auto beside = [](const std::string& ending) {
    return ending.empty() ? "" : fmt::format(" with its '{}'", ending);
  };
  for (std::size_t k = 0; k < written.size(); ++k) {
    const WrittenFile& file = written[k];
    if (is_stream(file.name)) continue;
    for (const std::string& ending : endings(file)) {
      const fs::path place = followed(file.name).string() + ending;
      for (const ReadFile& other : read)
        if (are_one(place, other.name))
          throw InputError(fmt::format("{} {}:{} would overwrite {} '{}'", file.what, file.name, beside(ending),
                                       other.what, other.name));
      for (std::size_t j = 0; j < k; ++j) {
        if (is_stream(written[j].name)) continue;
        for (const std::string& its : endings(written[j]))
          if (are_one(place, followed(written[j].name).string() + its))
            throw InputError(fmt::format("{} {}{} and {} {}{} are the same file", written[j].what, written[j].name,
                                         beside(its), file.what, file.name, beside(ending)));
      }
    }
  }
}

std::pair<std::uint64_t, std::uint64_t> file_identity(const fs::path& name) {
  struct stat about {};
  if (lstat(name.c_str(), &about) != 0) return {};
  return {about.st_dev, about.st_ino};
}

void publish(const fs::path& temporary, const fs::path& name) {
  const auto fail = [&](const std::string& what, int error) {
    throw WriteError(
        fmt::format("{}: {}: {}; it is left as {}", name.string(), what, reason(error), temporary.string()));
  };
  // A disk may find out only now that it is full, or gone.
  const auto flush = [&](const fs::path& place, bool is_folder) {
    const int descriptor = open(place.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return is_folder ? 0 : errno;  // a folder that may not be listed
    int error = fsync(descriptor) == 0 ? 0 : errno;
    if (error == EINVAL || error == ENOTSUP || error == EROFS) error = 0;  // file systems that cannot
    close(descriptor);
    return error;
  };
  if (const int error = flush(temporary, false)) fail("cannot be put on the disk", error);
  std::error_code problem;
  fs::rename(temporary, name, problem);
  if (problem) fail("cannot get its name", problem.value());
  if (const int error = flush(folder_of(name), true)) fail("its folder cannot be put on the disk", error);
}

TextFile::TextFile(const fs::path& name) {
  std::optional<int> number;
  name_ = follow(name, number);
  if (!is_stream(name_)) temporary_ = name_.string() + ".tmp";
  const int descriptor = number ? fcntl(*number, F_DUPFD_CLOEXEC, 3)
                         : temporary_.empty()
                             ? open(name_.c_str(), O_WRONLY | O_CLOEXEC)
                             : open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0) throw OpenError(fmt::format("{}: cannot be created: {}", name.string(), reason(errno)));
  if (!temporary_.empty()) removed_.emplace(temporary_);
  buffer_ = std::make_unique<DescriptorBuffer>(descriptor);
  stream_.rdbuf(buffer_.get());
}

TextFile::~TextFile() {
  if (finished_) return;
  buffer_.reset();
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void TextFile::finish() {
  if (const int error = static_cast<DescriptorBuffer&>(*buffer_).finish())
    throw WriteError(fmt::format("{}: cannot be written: {}", name_.string(), reason(error)));
  finished_ = true;
  if (!temporary_.empty()) publish(temporary_, name_);
}

void write_text_file(const fs::path& name, std::string_view text) {
  TextFile file(name);
  file.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  file.finish();
}

}  // namespace crumble
