#include "common/io/machine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/temporary_folder.hpp"

using namespace crumble;
using crumble::test::Folder;

namespace {

void put(const Folder& folder, const std::string& path, const std::string& text) {
  const std::filesystem::path file = folder.file(path);
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(Machine, memory_is_what_the_system_can_still_give) {
  const Folder folder;
  EXPECT_TRUE(std::isinf(this_machine(folder.file("")).memory)) << "nothing known, no limit";
  put(folder, "proc/meminfo", "MemTotal:   8000000 kB\nMemFree: 100 kB\nMemAvailable:    4000000 kB\n");
  EXPECT_EQ(this_machine(folder.file("")).memory, 4000000 * 1024.0);
  EXPECT_TRUE(std::isinf(this_machine(folder.file("")).processors));
}

TEST(Machine, groups_of_version_2_limit_from_the_own_one_to_the_top) {
  const Folder folder;
  put(folder, "proc/meminfo", "MemAvailable:    4000000 kB\n");
  put(folder, "proc/self/cgroup", "0::/user/job\n");
  put(folder, "sys/fs/cgroup/user/job/memory.max", "max\n");
  put(folder, "sys/fs/cgroup/user/job/cpu.max", "max 100000\n");
  EXPECT_EQ(this_machine(folder.file("")).memory, 4000000 * 1024.0);
  EXPECT_TRUE(std::isinf(this_machine(folder.file("")).processors));
  put(folder, "sys/fs/cgroup/user/memory.max", "1000000\n");
  put(folder, "sys/fs/cgroup/user/memory.current", "400000\n");
  put(folder, "sys/fs/cgroup/user/memory.stat", "anon 300000\ninactive_file 100000\n");
  put(folder, "sys/fs/cgroup/user/cpu.max", "150000 100000\n");
  EXPECT_EQ(this_machine(folder.file("")).memory, 700000);
  EXPECT_EQ(this_machine(folder.file("")).processors, 1.5);
}

TEST(Machine, groups_of_version_1_limit_too) {
  const Folder folder;
  put(folder, "proc/self/cgroup", "4:memory:/a/b\n2:cpu,cpuacct:/of/the/host\n");
  put(folder, "sys/fs/cgroup/memory/a/memory.limit_in_bytes", "500000\n");
  put(folder, "sys/fs/cgroup/memory/a/memory.usage_in_bytes", "600000\n");
  put(folder, "sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "50000\n");
  put(folder, "sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(this_machine(folder.file("")).memory, 0);
  EXPECT_EQ(this_machine(folder.file("")).processors, 0.5);
  put(folder, "sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  EXPECT_TRUE(std::isinf(this_machine(folder.file("")).processors));
}

TEST(Machine, a_quota_takes_threads_away_but_the_last) {
  unsetenv("OMP_NUM_THREADS");
  Machine machine;
  EXPECT_EQ(default_threads(8, machine), 8);
  machine.processors = 2.5;
  EXPECT_EQ(default_threads(8, machine), 2);
  EXPECT_EQ(default_threads(1, machine), 1);
  machine.processors = 0.5;
  EXPECT_EQ(default_threads(8, machine), 1);
  setenv("OMP_NUM_THREADS", "8", 1);
  EXPECT_EQ(default_threads(8, machine), 8) << "asked for";
  unsetenv("OMP_NUM_THREADS");
}

}  // namespace
