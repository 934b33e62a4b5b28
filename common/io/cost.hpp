// What a run has used, over all the processes that carried it on.
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <ctime>

namespace crumble {

struct Cost {
  double wall_s = 0, cpu_s = 0;
};

// CPU time of the calling thread, s: what a sample of a run is measured by, on a machine that does other things, too.
inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Wall time counts from its construction on, CPU time (user and system) is the whole process's; what earlier processes
// used is added.
class CostMeter {
 public:
  void add_earlier(const Cost& cost) { earlier_ = cost; }
  const Cost& earlier() const { return earlier_; }
  Cost used() const {
    rusage now{};
    getrusage(RUSAGE_SELF, &now);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    return {earlier_.wall_s + wall, earlier_.cpu_s + seconds(now.ru_utime) + seconds(now.ru_stime)};
  }

 private:
  static double seconds(const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  }

  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Cost earlier_;
};

}  // namespace crumble
