// Compares a file with the schema: form, and what its numbers must satisfy among themselves.
#pragma once

#include <filesystem>
#include <vector>

#include "common/io/form.hpp"

namespace crumble {

// Every violation found; empty means valid. Throws OpenError if the file cannot be opened, nothing else.
std::vector<Violation> check_file(const std::filesystem::path& path);

// The same for readers: throws ContentError with the first violation. In this process; a parent that has changed since
// is no fault of the numbers, and is not looked at.
void require_valid(const std::filesystem::path& path);

}  // namespace crumble
