// Where a result comes from: program, build, command, seed, parent file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace crumble {

struct Provenance {
  std::string program, version;
  std::string git;     // full commit hash, or "unknown"
  bool dirty = false;  // the sources differed from that commit
  std::string compiler, flags;
  std::string blas;     // whose dense kernels ran, as blas::description() says; empty in files of schema 1.0
  std::string command;  // as typed, quoted for a shell
  std::string created;  // ISO 8601, UTC
  std::uint64_t seed = 0;
  std::string rng = "none";
  std::string author;
  std::string parent, parent_sha256;  // empty without a parent
};

// The generator of all our noise, as provenance names it.
inline constexpr const char* philox = "Philox4x32-10 (Random123)";

// Filled in for this program, now. `arguments` are those of main, the program's own name first.
Provenance make_provenance(std::string program, const std::vector<std::string>& arguments, std::uint64_t seed,
                           std::string rng, const std::optional<std::filesystem::path>& parent = std::nullopt);

// What --version prints: version, commit, compiler, flags and libraries, one line each.
std::string version_text(const std::string& program);

}  // namespace crumble
