#include "common/io/checkpoint.hpp"

#include <fmt/core.h>

#include "common/io/errors.hpp"
#include "common/io/hdf5.hpp"
#include "common/io/in_child.hpp"
#include "common/io/output_file.hpp"

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

constexpr const char *used_wall = "used.wall_s", *used_cpu = "used.cpu_s";
void used_fields(SavedFields& f, Cost& used) {
  f(used_wall, used.wall_s);
  f(used_cpu, used.cpu_s);
}

template <class T>
void write_arrays(hdf5::File& file, const std::map<std::string, std::vector<T>>& arrays) {
  for (const auto& [name, values] : arrays)
    file.create_dataset<T>("/restart/" + name, {values.size()}).write(std::span<const T>(values));
}

SavedState read_restart(const std::filesystem::path& path, const CheckpointOwner& owner) {
  const hdf5::File file = hdf5::File::open(path);
  if (file.kind("/restart") != hdf5::Kind::group || file.kind("/restart/scene") != hdf5::Kind::dataset)
    throw ContentError(path.string() + ": not a checkpoint (no /restart)");
  const hdf5::Group group = file.group("/restart");
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}; remove it to start anew, or run what it was made by", path.string(), what));
  };
  const std::string program = group.text_attribute("program").at(0), version = group.text_attribute("version").at(0);
  if (program != owner.program) refuse("a checkpoint of " + program + ", not of " + owner.program);
  if (version != owner.version) refuse("made by version " + version + ", this is " + owner.version);
  const std::string scene = file.dataset("/restart/scene").read_text();
  if (scene != owner.scene) refuse("made from another scene: " + first_difference(scene, owner.scene));

  SavedState state;
  for (const std::string& name : group.names()) {
    if (name == "scene") continue;
    const hdf5::Dataset dataset = file.dataset("/restart/" + name);
    if (dataset.type() == hdf5::Type::float64) state.reals[name] = dataset.read<double>();
    if (dataset.type() == hdf5::Type::int64) state.integers[name] = dataset.read<std::int64_t>();
  }
  return state;
}

}  // namespace

void save_checkpoint(const std::filesystem::path& path, const CheckpointOwner& owner, const SavedState& state) {
  const std::filesystem::path temporary = path.string() + ".tmp";
  // No half of it is left on a full disk.
  struct Remover {
    const std::filesystem::path& name;
    bool armed = true;
    ~Remover() {
      std::error_code ignored;
      if (armed) std::filesystem::remove(name, ignored);
    }
  } remover{temporary};
  hdf5::File file = hdf5::File::create(temporary);
  hdf5::Group group = file.create_group("/restart");
  group.set_attribute("program", std::string_view(owner.program));
  group.set_attribute("version", std::string_view(owner.version));
  file.write_text("/restart/scene", owner.scene);
  write_arrays(file, state.reals);
  write_arrays(file, state.integers);
  file.close();
  publish(temporary, path);
  remover.armed = false;
}

SavedState load_checkpoint(const std::filesystem::path& path, const CheckpointOwner& owner) {
  in_child(path, [&] { return read_restart(path, owner), std::string(); });
  return read_restart(path, owner);
}

void keep_and_rethrow(const std::function<void()>& keep) {
  std::string problem;
  try {
    keep();
  } catch (const std::exception& error) {
    problem = error.what();
  }
  if (problem.empty()) throw;
  try {
    throw;
  } catch (const Interrupted& stop) {
    throw Interrupted(stop.signal, fmt::format("{}; the state cannot be kept: {}", stop.what(), problem));
  }
}

OutputCheckpoint::OutputCheckpoint(const std::string& output, CheckpointOwner owner)
    : path_(output + ".checkpoint"),
      owner_(std::move(owner)),
      found_(std::filesystem::exists(path_) && std::filesystem::exists(output + ".tmp")) {
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

void OutputCheckpoint::store(const std::function<void(SavedFields&)>& visit) const {
  SavedState state;
  SavedFields f = SavedFields::saver(state);
  Cost used = meter_.used();
  used_fields(f, used);
  visit(f);
  save_checkpoint(path_, owner_, state);
}

void OutputCheckpoint::require() const {
  if (found_) return;
  throw InputError(fmt::format(
      "--restart: there is no {} with its unfinished output; without --restart the run begins at its start", path_));
}

void OutputCheckpoint::remove() const { std::filesystem::remove(path_); }

}  // namespace crumble
