#include "common/io/interrupt.hpp"

#include <fmt/format.h>
#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <list>
#include <mutex>
#include <system_error>
#include <thread>

namespace crumble {
namespace {

std::atomic<int> arrived{0};
std::atomic<std::int64_t> arrived_at{0};  // ns
std::atomic<bool> watching{false};
// Else a handler may not touch them.
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);
constexpr std::int64_t one_request = 1'000'000'000;  // ns
sem_t signalled, over;

// Neither is ever destroyed: the thread that waits outlives main.
struct Endings {
  std::mutex mutex;
  std::string program;
  std::list<std::pair<const AtSuddenEnd*, std::function<std::string()>>> actions;
  std::mutex of_files;  // a mutex of its own, since the actions write files
  std::list<std::pair<const RemovedAtSuddenEnd*, std::filesystem::path>> files;
};
Endings& endings() {
  static auto* const all = new Endings;
  return *all;
}

std::int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return 1'000'000'000 * static_cast<std::int64_t>(time.tv_sec) + time.tv_nsec;
}

extern "C" void note_signal(int signal_number) {
  const int kept = errno;
  int none = 0;
  if (arrived.compare_exchange_strong(none, signal_number)) {
    arrived_at = now();
    sem_post(&signalled);
  } else if (const std::int64_t first = arrived_at; first != 0 && now() - first > one_request) {
    _exit(128 + signal_number);
  }
  errno = kept;
}

void wait_for(sem_t& semaphore) {
  while (sem_wait(&semaphore) != 0 && errno == EINTR) {
  }
}

bool comes_within(sem_t& semaphore, long milliseconds) {
  timespec until{};
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += 1'000'000 * milliseconds;
  until.tv_sec += until.tv_nsec / 1'000'000'000;
  until.tv_nsec %= 1'000'000'000;
  int ended = 0;
  while ((ended = sem_timedwait(&semaphore, &until)) != 0 && errno == EINTR) {
  }
  return ended == 0;
}

// The last that was asked for is done first; its words are the ones that matter.
std::string do_all() {
  const std::lock_guard lock(endings().mutex);
  std::string words;
  for (auto it = endings().actions.rbegin(); it != endings().actions.rend(); ++it) {
    try {
      const std::string said = it->second();
      if (words.empty()) words = said;
    } catch (const std::exception& error) {
      if (words.empty()) words = fmt::format("stopped; the state cannot be kept: {}", error.what());
    }
  }
  if (words.empty()) words = "stopped; there was nothing to keep: the same command begins anew";
  return fmt::format("{}{}{}\n", endings().program, endings().program.empty() ? "" : ": ", words);
}

void remove_files() {
  const std::lock_guard lock(endings().of_files);
  std::error_code ignored;
  for (const auto& [owner, file] : endings().files) std::filesystem::remove(file, ignored);
}

void wait_and_end() {
  for (;;) {
    wait_for(signalled);
    if (comes_within(over, 500) || !watching || arrived == 0) continue;
    const std::string words = do_all();
    if (comes_within(over, 100)) continue;
    remove_files();
    for (std::size_t done = 0; done < words.size();) {
      const auto count = write(STDERR_FILENO, words.data() + done, words.size() - done);
      if (count <= 0) break;
      done += static_cast<std::size_t>(count);
    }
    _exit(128 + arrived);
  }
}

void start_waiting() {
  sem_init(&signalled, 0, 0);
  sem_init(&over, 0, 0);
  try {
    std::thread(wait_and_end).detach();
  } catch (const std::system_error&) {
  }  // a limit on threads: then a program ends where it asks for the signal
}

}  // namespace

void watch_for_interrupts(const std::string& program) {
  static std::once_flag once;
  std::call_once(once, start_waiting);
  arrived = 0;
  arrived_at = 0;
  watching = true;
  while (sem_trywait(&over) == 0) {  // of a body before this one
  }
  {
    const std::lock_guard lock(endings().mutex);
    endings().program = program;
  }
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void end_watch() noexcept {
  watching = false;
  sem_post(&over);
}

int interrupt_signal() noexcept { return arrived.load(std::memory_order_relaxed); }

AtSuddenEnd::AtSuddenEnd(std::function<std::string()> action) {
  const std::lock_guard lock(endings().mutex);
  endings().actions.emplace_back(this, std::move(action));
}

AtSuddenEnd::~AtSuddenEnd() {
  const std::lock_guard lock(endings().mutex);
  endings().actions.remove_if([this](const auto& entry) { return entry.first == this; });
}

RemovedAtSuddenEnd::RemovedAtSuddenEnd(std::filesystem::path file) {
  const std::lock_guard lock(endings().of_files);
  endings().files.emplace_back(this, std::move(file));
}

RemovedAtSuddenEnd::~RemovedAtSuddenEnd() {
  const std::lock_guard lock(endings().of_files);
  endings().files.remove_if([this](const auto& entry) { return entry.first == this; });
}

}  // namespace crumble
