#include "breaker/companion.hpp"

#include <chrono>

namespace crumble::breaker {

Companion::Companion(const BreakerScene& scene, const Agglomerate& start, bool beside, SavedState saved)
    : scene_(scene), start_(start), state_(std::move(saved)) {
  scene_.until_stable = false;
  if (beside) thread_ = std::thread([this] { run(); });
}

Companion::~Companion() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void Companion::begin() {
  run_.emplace(scene_, start_, scene_.is(IntegratorKind::explicit_euler) ? 0.5 : 2);
  if (!state_.integers.empty()) load(*run_, state_);
}

void Companion::publish() {
  SavedState now = save(*run_);
  const std::lock_guard lock(mutex_);
  state_ = std::move(now);
}

void Companion::run() {
  try {
    begin();
    while (!run_->finished() && !stop_) {
      run_->step();
      if (wanted_.exchange(false)) publish();
    }
    publish();
  } catch (...) {
    failure_ = std::current_exception();
  }
  over_ = true;
}

SavedState Companion::state() {
  constexpr int most = 20;  // ms
  if (thread_.joinable()) {
    wanted_ = true;
    for (int waited = 0; waited < most && wanted_ && !over_; ++waited)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } else if (run_) {
    publish();
  }
  const std::lock_guard lock(mutex_);
  return state_;
}

double Companion::outcome(const std::function<void()>& between_steps) {
  if (thread_.joinable()) {
    for (; !over_; std::this_thread::sleep_for(std::chrono::milliseconds(1))) between_steps();
    thread_.join();
    if (failure_) std::rethrow_exception(failure_);
  } else {
    begin();
    for (; !run_->finished(); run_->step()) between_steps();
  }
  const auto& severed = run_->breakup().severed;
  return severed ? severed->measure : std::numeric_limits<double>::infinity();
}

}  // namespace crumble::breaker
