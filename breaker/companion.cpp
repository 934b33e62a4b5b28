#include "breaker/companion.hpp"

#include "common/io/errors.hpp"
#include "common/io/interrupt.hpp"

namespace crumble::breaker {

Companion::Companion(const BreakerScene& scene, const Agglomerate& start, bool beside) : scene_(scene), start_(start) {
  scene_.until_stable = false;
  if (beside) thread_ = std::thread([this] { run(); });
}

Companion::~Companion() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void Companion::run() {
  try {
    BreakupRun run(scene_, start_, scene_.is_explicit ? 0.5 : 2);
    while (!run.finished()) {
      run.step();
      if (interrupt_signal())
        throw Interrupted(interrupt_signal(), "stopped during the error estimate, which begins anew");
      if (stop_) return;
    }
    if (run.breakup().severed) result_ = *run.breakup().severed;
    done_ = true;
  } catch (...) {
    failure_ = std::current_exception();
  }
}

double Companion::critical_stress() {
  if (thread_.joinable())
    thread_.join();
  else if (!done_)
    run();
  if (failure_) std::rethrow_exception(failure_);
  return result_;
}

}  // namespace crumble::breaker
