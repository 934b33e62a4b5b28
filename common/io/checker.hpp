// Compares a file with the schema: form, and what its numbers must satisfy among themselves.
#pragma once

#include <filesystem>
#include <vector>

#include "common/io/form.hpp"

namespace crumble {

// Every violation found; empty means valid. Throws OpenError if the file cannot be opened, nothing else.
std::vector<Violation> check_file(const std::filesystem::path& path);

}  // namespace crumble
