#include "common/io/frame_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <system_error>

#include "common/agglomerate/saved_frame.hpp"
#include "common/io/file_errors.hpp"
#include "common/io/state_stream.hpp"

namespace crumble {
namespace {

constexpr std::string_view observable = "observable.", series = "series.";

std::string reason(int error) { return std::generic_category().message(error); }

std::filesystem::path beside(const std::filesystem::path& output) { return output.string() + ".frames"; }

int open_log(const std::filesystem::path& path, int how) {
  const int descriptor = open(path.c_str(), how | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0) throw OpenError(fmt::format("{}: cannot be written: {}", path.string(), reason(errno)));
  return descriptor;
}

// Called where the number was made, long before the output is written.
void refuse_non_finite(const std::filesystem::path& path, const SavedState& record) {
  for (const auto& [name, values] : record.reals)
    for (const double value : values)
      if (!std::isfinite(value))
        throw ContentError(fmt::format("{}: {} would hold {}: numbers must be finite", path.string(), name, value));
}

// Observables of a record, which are then no longer in it.
Observables observables_in(SavedState& record) {
  Observables found;
  for (const auto& [name, values] : record.reals)
    if (name.starts_with(observable)) found.emplace_back(name.substr(observable.size()), values.at(0));
  std::erase_if(record.reals, [](const auto& array) { return array.first.starts_with(observable); });
  return found;
}

}  // namespace

void FrameLog::Mark::fields(SavedFields f) {
  f("bytes", bytes);
  f("records", records);
  std::vector<std::int64_t> letters(sha256.begin(), sha256.end());
  f("sha256", letters);
  sha256.assign(letters.begin(), letters.end());
}

FrameLog::FrameLog(const std::filesystem::path& output)
    : path_(beside(output)), descriptor_(open_log(path_, O_CREAT | O_TRUNC)) {}

FrameLog::FrameLog(const std::filesystem::path& output, const Mark& mark)
    : path_(beside(output)), bytes_(mark.bytes), records_(mark.records), kept_(true) {
  const auto refuse = [&](const char* what) {
    throw ContentError(
        fmt::format("{}: {}; remove it and {}.checkpoint to start anew", path_.string(), what, output.string()));
  };
  if (!std::filesystem::exists(path_)) refuse("is missing, and the checkpoint needs it");
  if (std::filesystem::file_size(path_) < static_cast<std::uint64_t>(bytes_)) refuse("is damaged: it is too short");
  StateReader reader(path_, static_cast<std::uint64_t>(bytes_));
  reader.skip_to_end();
  if (reader.digest().hex() != mark.sha256) refuse("is damaged: not what was written");
  digest_ = reader.take_digest();
  descriptor_ = open_log(path_, 0);
  cut();
}

FrameLog::~FrameLog() {
  if (descriptor_ < 0) return;
  if (kept_)
    close(descriptor_);
  else
    remove();
}

void FrameLog::put(const SavedState& record) {
  refuse_non_finite(path_, record);
  std::vector<char> block;
  const auto write_block = [&] {
    for (std::size_t done = 0; done < block.size();) {
      const auto count = write(descriptor_, block.data() + done, block.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) {
        const int error = errno;
        if (ftruncate(descriptor_, bytes_) == 0) lseek(descriptor_, bytes_, SEEK_SET);  // no half record
        throw WriteError(fmt::format("{}: cannot be written: {}", path_.string(), reason(error)));
      }
      done += static_cast<std::size_t>(count);
    }
    block.clear();
  };
  std::int64_t bytes = 0;
  Sha256 digest = digest_.copy();
  put_state(record, [&](std::span<const char> more) {
    digest.add(more);
    bytes += std::ssize(more);
    block.insert(block.end(), more.begin(), more.end());
    if (block.size() > 1 << 16) write_block();
  });
  write_block();
  digest_ = std::move(digest);
  bytes_ += bytes;
  ++records_;
}

void FrameLog::append(const Frame& frame, const Observables& observables) {
  SavedState record;
  SavedFields f = SavedFields::saver(record);
  Frame whole = frame;
  saved_frame(f.in("frame"), whole);
  for (const auto& [name, value] : observables) record.reals[std::string(observable) + name] = {value};
  put(record);
}

void FrameLog::sample(std::int64_t step, double time, const std::vector<Sample>& samples) {
  SavedState record;
  record.integers["sample"] = {step};
  record.reals["time"] = {time};
  for (const Sample& s : samples) record.reals[fmt::format("{}{} {}", series, s.name, s.unit)] = {s.value};
  put(record);
}

FrameLog::Mark FrameLog::mark() const { return {bytes_, records_, digest_.hex()}; }

void FrameLog::flush() const {
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP)
    throw WriteError(fmt::format("{}: cannot be put on the disk: {}", path_.string(), reason(errno)));
}

void FrameLog::write_to(AgglomerateWriter& writer) const {
  StateReader reader(path_, static_cast<std::uint64_t>(bytes_));
  while (reader.left() > 0) {
    SavedState record = reader.state();
    if (record.integers.contains("sample")) {
      const std::int64_t step = record.integers["sample"].at(0);
      for (const auto& [name, values] : record.reals) {
        if (!name.starts_with(series)) continue;
        const auto space = name.find(' ');
        writer.sample(name.substr(series.size(), space - series.size()), name.substr(space + 1), step,
                      record.reals["time"].at(0), values.at(0));
      }
      continue;
    }
    const Observables observables = observables_in(record);
    SavedFields f = SavedFields::loader(std::move(record));
    Frame frame;
    saved_frame(f.in("frame"), frame);
    writer.append(frame, observables);
  }
  if (reader.digest().hex() != digest_.hex()) reader.damaged();
}

void FrameLog::remove() {
  close(descriptor_);
  descriptor_ = -1;
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void FrameLog::begin_anew() {
  bytes_ = records_ = 0;
  digest_ = {};
}

void FrameLog::cut() {
  if (ftruncate(descriptor_, bytes_) != 0 || lseek(descriptor_, 0, SEEK_END) < 0)
    throw WriteError(fmt::format("{}: cannot be cut: {}", path_.string(), reason(errno)));
}

}  // namespace crumble
