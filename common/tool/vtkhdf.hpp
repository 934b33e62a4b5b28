// Export for ParaView: VTKHDF files, one a frame.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble::tool {

// One frame as an UnstructuredGrid, format version 1.0 (what VTK 9.1 and ParaView 5.11 read). Lengths in nm, the rest
// SI. A vertex for each particle, with its point data; a line for each contact, with its cell data (on the vertices,
// where it means nothing, NaN; contact = 1 on lines, 0 on vertices). Written under a temporary name, then renamed.
void write_vtkhdf(const std::filesystem::path& path, const Particles& particles, const Frame& frame);

// The list of frames that ParaView opens as one data set with its times (s): FILE.hdf.series.
std::string series_text(const std::vector<std::pair<std::string, double>>& file_and_time);

}  // namespace crumble::tool
