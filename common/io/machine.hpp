// What this machine, or the share of it that a control group allows, has to give.
#pragma once

#include <filesystem>
#include <limits>

namespace crumble {

struct Machine {
  double memory = std::numeric_limits<double>::infinity();      // that a process can still take, bytes
  double processors = std::numeric_limits<double>::infinity();  // by the quotas of control groups; others set no limit
};

// The least of MemAvailable (proc(5)), of what the control groups of this process leave (limit less usage, in which
// files that can be dropped do not count) and, at the true root, of its limit of address space (ulimit -v). Groups of
// version 2 (memory.max, cpu.max) and 1 (memory.limit_in_bytes, cpu.cfs_quota_us), from the process's own up to the
// top; what cannot be read sets no limit. root: where proc and sys/fs/cgroup are, for tests.
// Source: Linux, admin-guide/cgroup-v2.rst and cgroup-v1/memory.rst.
Machine this_machine(const std::filesystem::path& root = "/");

// Threads of a program that was not told a number: as many as OpenMP takes by itself, unless control groups allow less.
// A number in OMP_NUM_THREADS is obeyed.
int default_threads(int of_openmp, const Machine& machine);

// Waiting threads spin for some microseconds and then sleep, so that they take nothing from other work. libgomp, which
// spins for milliseconds where nobody says otherwise, reads that from the environment before main() begins: starts the
// program anew with it, once, unless the user has said something. Call first in main().
void wait_without_spinning(char** argv);

}  // namespace crumble
