#include "common/io/provenance.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <chrono>
#include <ctime>

#include "build_info.hpp"
#include "common/io/hdf5.hpp"
#include "common/io/sha256.hpp"
#include "common/numerics/blas.hpp"
#include "git_revision.hpp"

namespace crumble {

namespace {

std::string shell_quoted(const std::string& argument) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%^";
  if (!argument.empty() && argument.find_first_not_of(plain) == argument.npos) return argument;
  std::string quoted = "'";
  for (char c : argument) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string author() {
  const passwd* user = getpwuid(geteuid());
  if (!user) return "unknown";
  const std::string full = user->pw_gecos ? user->pw_gecos : "";
  const std::string name = full.substr(0, full.find(','));
  return name.empty() ? user->pw_name : name;
}

}  // namespace

Provenance make_provenance(std::string program, const std::vector<std::string>& arguments, std::uint64_t seed,
                           std::string rng, const std::optional<std::filesystem::path>& parent) {
  Provenance provenance;
  provenance.program = std::move(program);
  provenance.version = build::version;
  provenance.git = build::git;
  provenance.dirty = build::dirty;
  provenance.compiler = build::compiler;
  provenance.flags = build::flags;
  provenance.blas = blas::description();
  for (const auto& argument : arguments)
    provenance.command += (provenance.command.empty() ? "" : " ") + shell_quoted(argument);
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  provenance.created = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
  provenance.seed = seed;
  provenance.rng = std::move(rng);
  provenance.author = author();
  if (parent) {
    provenance.parent = parent->string();
    provenance.parent_sha256 = sha256_of_file(*parent);
  }
  return provenance;
}

std::string version_text(const std::string& program) {
  return fmt::format("{} {}\ncommit {}{}\ncompiler {}\nflags {}\nHDF5 {}\nBLAS {}\n", program, build::version,
                     build::git, build::dirty ? " with changes" : "", build::compiler, build::flags,
                     hdf5::library_version(), blas::description());
}

}  // namespace crumble
