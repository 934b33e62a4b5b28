// What a run has used, over all the processes that carried it on.
#pragma once

#include <sys/resource.h>

namespace crumble {

struct Cost {
  double wall_s = 0, cpu_s = 0;
};

// User and system time of this process so far, s.
inline double process_cpu_seconds() {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

}  // namespace crumble
