#include "common/io/checkpoint.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "common/io/file_errors.hpp"
#include "common/io/output_file.hpp"
#include "common/io/state_stream.hpp"

namespace crumble {

namespace {

// Where two texts first differ, for a message: the two lines.
std::string first_difference(const std::string& before, const std::string& now) {
  std::size_t start = 0, k = 0;
  for (; k < before.size() && k < now.size() && before[k] == now[k]; ++k)
    if (before[k] == '\n') start = k + 1;
  const auto line = [start](const std::string& text) {
    return start < text.size() ? text.substr(start, text.find('\n', start) - start) : std::string("(nothing)");
  };
  return fmt::format("'{}' then, '{}' now", line(before), line(now));
}

// When to save is no part of what is computed.
std::string without_interval(const std::string& scene) {
  const auto begin = scene.find("\ncheckpoint_interval ");
  if (begin == std::string::npos) return scene;
  return scene.substr(0, begin) + scene.substr(std::min(scene.find('\n', begin + 1), scene.size()));
}

constexpr const char *used_wall = "used.wall_s", *used_cpu = "used.cpu_s";
void used_fields(SavedFields& f, Cost& used) {
  f(used_wall, used.wall_s);
  f(used_cpu, used.cpu_s);
}

// The last figure is that of the format.
constexpr std::string_view heading = "Crumble checkpoint 2\n";
constexpr std::uint64_t digest_size = 64;  // hexadecimal digits, at the end

}  // namespace

void save_checkpoint(const std::filesystem::path& path, const CheckpointOwner& owner, const SavedState& state) {
  TextFile file(path);
  Sha256 digest;
  const auto put = [&](std::span<const char> bytes) {
    file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    digest.add(bytes);
  };
  put(heading);
  for (const std::string* text : {&owner.program, &owner.version, &owner.scene}) put_text(*text, put);
  put_state(state, put);
  file.stream() << digest.hex();
  file.finish();
}

SavedState load_checkpoint(const std::filesystem::path& path, const CheckpointOwner& owner) {
  StateReader reader(path);
  if (reader.left() < heading.size() + digest_size || reader.exactly(heading.size()) != heading)
    throw ContentError(path.string() + ": not a checkpoint of this version; remove it to start anew");
  CheckpointOwner writer;
  SavedState state;
  try {
    for (std::string* text : {&writer.program, &writer.version, &writer.scene}) *text = reader.text();
    state = reader.state();
    if (reader.left() != digest_size) reader.damaged();
    const std::string digest = reader.digest().hex();
    if (reader.exactly(digest_size) != digest) reader.damaged();
  } catch (const ContentError& error) {
    throw ContentError(std::string(error.what()) + "; remove it to start anew");
  }
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}; remove it to start anew, or run what it was made by", path.string(), what));
  };
  if (writer.program != owner.program) refuse("a checkpoint of " + writer.program + ", not of " + owner.program);
  if (writer.version != owner.version) refuse("made by version " + writer.version + ", this is " + owner.version);
  if (writer.scene != owner.scene) refuse("made from another scene: " + first_difference(writer.scene, owner.scene));
  return state;
}

OutputCheckpoint::OutputCheckpoint(const std::string& output, CheckpointOwner owner)
    : output_(output), path_(output + ".checkpoint"), owner_(std::move(owner)), found_(std::filesystem::exists(path_)) {
  owner_.scene = without_interval(owner_.scene);
  if (!found_) return;
  stored_ = load_checkpoint(path_, owner_);
  Cost used = restored([](SavedFields& f) {
    Cost cost;
    used_fields(f, cost);
    return cost;
  });
  for (const char* name : {used_wall, used_cpu}) stored_.reals.erase(name);
  meter_.add_earlier(used);
}

void OutputCheckpoint::refuse(const std::string& what) const {
  throw InputError(
      fmt::format("{}: {}: it was made by another build of this program; remove it to start anew", path_, what));
}

std::string OutputCheckpoint::leftovers() const {
  std::string names;
  for (const char* ending : {".tmp", ".frames", ".checkpoint.tmp"}) {
    std::error_code ignored;
    if (found_ && ending == std::string_view(".frames")) continue;
    if (std::filesystem::remove(output_ + ending, ignored)) names += (names.empty() ? "" : ", ") + output_ + ending;
  }
  if (names.empty()) return "";
  return fmt::format("removed what a run left that was killed: {}{}", names,
                     found_ ? "" : "; there is no checkpoint, so this one begins anew");
}

SavedState OutputCheckpoint::collect(const std::function<void(SavedFields&)>& visit) const {
  SavedState state;
  SavedFields f = SavedFields::saver(state);
  Cost used = meter_.used();
  used_fields(f, used);
  visit(f);
  return state;
}

void OutputCheckpoint::write(const SavedState& state) const { save_checkpoint(path_, owner_, state); }

void OutputCheckpoint::require() const {
  if (found_) return;
  throw InputError(fmt::format("--restart: there is no {}; without --restart the run begins at its start", path_));
}

void OutputCheckpoint::remove() const { std::filesystem::remove(path_); }

}  // namespace crumble
