// SHA-256 digests, 64 lower-case hexadecimal digits.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace crumble {

std::string sha256_of_text(std::string_view text);
std::string sha256_of_file(const std::filesystem::path& path);  // throws OpenError

}  // namespace crumble
