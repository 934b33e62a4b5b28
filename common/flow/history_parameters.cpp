#include "common/flow/history_parameters.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace crumble {

namespace {

std::string history_name(const Scene& scene) {
  return (std::filesystem::path(scene.file()).parent_path() / scene.text("flow.history")).string();
}

}  // namespace

std::vector<Parameter> history_parameters(const std::string& what_many_do) {
  return {Parameter::text("history",
                          "CSV file of time [s] and nine components of the velocity gradient [1/s], as seen from the "
                          "scene; or many: a folder of such files, or an HDF5 file of tracks, " +
                              what_many_do)
              .optional(),
          Parameter::integer("track",
                             "Of many histories this one alone, counted from 1 in the HDF5 file, or among the names of "
                             "the folder in their order")
              .at_least(1)
              .optional(),
          Parameter::real("largest_history_step", "", "A longer strain between two rows of the history is refused")
              .above(0)
              .by_default(1)};
}

FlowHistory flow_history_in(const Scene& scene) {
  FlowHistory found;
  const bool one_track = scene.is_set("flow.track");
  if (!scene.is_set("flow.history")) {
    if (one_track) throw scene.error("flow.track", "a track of what? flow.history names none");
    return found;
  }
  const std::string name = history_name(scene);
  const double step = scene.real("flow.largest_history_step");
  if (!is_many_tracks(name)) {
    if (one_track) throw scene.error("flow.track", name + " is one history: there is nothing to choose from");
    found.one = GradientHistory::read(name, step);
    return found;
  }
  found.many = read_tracks(name, step);
  if (!one_track) return found;
  const std::int64_t number = scene.integer("flow.track");
  if (number > static_cast<std::int64_t>(found.many->size))
    throw scene.error("flow.track", fmt::format("{} holds {} tracks", name, found.many->size));
  found.one = found.many->read(static_cast<std::size_t>(number - 1));
  found.many.reset();
  return found;
}

std::vector<ReadFile> history_files(const Scene& scene) {
  if (!scene.is_set("flow.history")) return {};
  const std::string name = history_name(scene);
  if (!is_many_tracks(name)) return {{"the history", name}};
  std::vector<ReadFile> files;
  for (const std::string& file : track_files(name)) files.push_back({"a track", file});
  return files;
}

}  // namespace crumble
