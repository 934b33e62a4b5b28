// Many histories of the velocity gradient: a folder of CSV files, or one HDF5 file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/flow/gradient_history.hpp"

namespace crumble {

// Histories that may be too many to be held: each is made when it is asked for, by one thread at a time.
struct Tracks {
  std::size_t size = 0;
  std::function<GradientHistory(std::size_t)> read;
};

// Whether this names many histories rather than one CSV file.
bool is_many_tracks(const std::string& name);

// The files that hold them: those of the folder that end in .csv, by name, or the one HDF5 file. Throws InputError
// where there are none.
std::vector<std::string> track_files(const std::string& name);

// Each CSV file as GradientHistory::read takes it. An HDF5 file holds /time (instants, in s: attribute unit = "s") and
// /gradient (tracks x instants x 3 x 3, row i, column j: du_i/dx_j; unit = "s-1" or "1/s"). Throws InputError, naming
// file and track or line.
Tracks read_tracks(const std::string& name, double largest_step);

}  // namespace crumble
