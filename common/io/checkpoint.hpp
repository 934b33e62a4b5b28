// The exact state of an interrupted run, private to the program that wrote it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/io/errors.hpp"

namespace crumble {

// Arrays by name, in the program's own units, stored to the bit under /restart.
struct Checkpoint {
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<std::int64_t>> integers;

  // Throw ContentError naming the array if it is missing.
  const std::vector<double>& real(const std::string& name) const;
  const std::vector<std::int64_t>& integer(const std::string& name) const;
};

// Who may continue: the same program, version and resolved scene.
struct CheckpointOwner {
  std::string program, version, scene;  // scene: the resolved text
};

// Written under a temporary name and renamed: there is always one whole checkpoint or none.
void save_checkpoint(const std::filesystem::path& path, const CheckpointOwner& owner, const Checkpoint& checkpoint);

// Throws InputError saying which of program, version and scene differs and what to do, ContentError if the file is not
// a checkpoint.
Checkpoint load_checkpoint(const std::filesystem::path& path, const CheckpointOwner& owner);

// What to say to who asked for a checkpoint that is not there, or whose unfinished output is gone.
InputError no_checkpoint(const std::filesystem::path& path);

}  // namespace crumble
