#include "common/io/machine.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace crumble {

namespace {

namespace fs = std::filesystem;

// The first number of a file; nothing if it is not there or holds a word, such as "max".
std::optional<double> number(const fs::path& file) {
  double value = 0;
  if (std::ifstream in(file); in >> value) return value;
  return std::nullopt;
}

// The number behind a word at the beginning of a line.
std::optional<double> number(const fs::path& file, const std::string& word) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string first;
    double value = 0;
    if (words >> first >> value && first == word) return value;
  }
  return std::nullopt;
}

// cpu.max holds "quota period" or "max period".
void limit_processors(const fs::path& group, Machine& machine) {
  double quota = 0, period = 0;
  if (std::ifstream in(group / "cpu.max"); in >> quota >> period && period > 0)
    machine.processors = std::min(machine.processors, quota / period);
  const auto old_quota = number(group / "cpu.cfs_quota_us"), old_period = number(group / "cpu.cfs_period_us");
  if (old_quota && old_period && *old_quota > 0 && *old_period > 0)
    machine.processors = std::min(machine.processors, *old_quota / *old_period);
}

void limit_memory(const fs::path& group, Machine& machine) {
  const auto limit = [&](const char* most, const char* used, const char* droppable) {
    const auto total = number(group / most);
    if (!total) return;
    const double usage = number(group / used).value_or(0);
    const double files = std::min(number(group / "memory.stat", droppable).value_or(0), usage);
    machine.memory = std::min(machine.memory, std::max(*total - usage + files, 0.0));
  };
  limit("memory.max", "memory.current", "inactive_file");
  limit("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file");
}

// From the group of the process up to the mount. Within a container the path may be that of the host: then only what is
// mounted is there.
template <class Limit>
void climb(const fs::path& mount, std::string group, Machine& machine, Limit limit) {
  for (;;) {
    limit(mount / fs::path(group).relative_path(), machine);
    if (group.empty() || group == "/") return;
    group = fs::path(group).parent_path().string();
  }
}

}  // namespace

Machine this_machine(const fs::path& root) {
  Machine machine;
  if (const auto kilobytes = number(root / "proc/meminfo", "MemAvailable:")) machine.memory = 1024 * *kilobytes;
  rlimit space{};
  if (root == "/" && getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
    machine.memory = std::min(machine.memory, static_cast<double>(space.rlim_cur));
  std::ifstream groups(root / "proc/self/cgroup");
  const fs::path mounts = root / "sys/fs/cgroup";
  // hierarchy:controllers:path; version 2 has no controllers.
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
    for (const fs::path& mount :
         controllers.empty() ? std::vector{mounts, mounts / "unified"} : std::vector{mounts / controllers}) {
      climb(mount, path, machine, limit_memory);
      climb(mount, path, machine, limit_processors);
    }
  }
  return machine;
}

int default_threads(int of_openmp, const Machine& machine) {
  if (std::getenv("OMP_NUM_THREADS")) return of_openmp;
  return static_cast<int>(std::clamp(std::floor(machine.processors), 1.0, static_cast<double>(of_openmp)));
}

void wait_without_spinning(char** argv) {
  for (const char* said : {"OMP_WAIT_POLICY", "GOMP_SPINCOUNT"})
    if (std::getenv(said)) return;
  if (setenv("GOMP_SPINCOUNT", "100", 0) == 0) execv("/proc/self/exe", argv);  // goes on here if that is not possible
}

}  // namespace crumble
