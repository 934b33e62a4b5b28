// The keys by which a scene names a history of the velocity gradient.
#pragma once

#include <optional>
#include <vector>

#include "common/flow/gradient_history.hpp"
#include "common/flow/tracks.hpp"
#include "common/io/output_file.hpp"
#include "common/io/parameters.hpp"

namespace crumble {

// flow.history, flow.track, flow.largest_history_step, for the section "flow".
// what_many_do: what a program makes of a folder or an HDF5 file of tracks when no track is named.
std::vector<Parameter> history_parameters(const std::string& what_many_do);

struct FlowHistory {
  std::optional<GradientHistory> one;
  std::optional<Tracks> many;
};

// Neither where the scene names none. A name is as seen from the scene's folder. Throws InputError naming file and
// line.
FlowHistory flow_history_in(const Scene& scene);

// The files that flow.history names.
std::vector<ReadFile> history_files(const Scene& scene);

}  // namespace crumble
