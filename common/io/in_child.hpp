// The HDF5 library trusts what it reads: on damaged metadata version 1.10.8 can crash or loop (about 6 of 1000 files
// with one to four bytes changed). So a file is first read in a child process, where that costs nothing but an error.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace crumble {

// What `work` returns, computed in a child process. OpenError and ContentError come through; a child that crashes or
// exceeds the time or memory that a file of this size can need is a ContentError.
std::string in_child(const std::filesystem::path& file, const std::function<std::string()>& work);

}  // namespace crumble
