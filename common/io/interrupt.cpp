#include "common/io/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace crumble {
namespace {

std::atomic<int> arrived{0};
static_assert(std::atomic<int>::is_always_lock_free);  // else a handler may not touch it

extern "C" void note_signal(int signal_number) { arrived.store(signal_number, std::memory_order_relaxed); }

}  // namespace

void watch_for_interrupts() {
  arrived = 0;
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);  // the second signal finds the default action
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int interrupt_signal() noexcept { return arrived.load(std::memory_order_relaxed); }

}  // namespace crumble
