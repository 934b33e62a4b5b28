#include "dryer/activity.hpp"

#include <algorithm>

namespace crumble::dryer {

Activity::Activity(const Particles& particles, const Frame& frame) : active_(particles.size(), 0) {
  for (std::size_t p = 0; p < particles.size(); ++p)
    waiting_.emplace_back(frame.position[p].norm() + particles.radius[p], static_cast<std::int32_t>(p));
  std::sort(waiting_.begin(), waiting_.end());
  for (const Contact& bond : frame.contacts) {
    wake(bond.i);
    wake(bond.j);
  }
}

bool Activity::front_at(double R) {
  bool woke = false;
  while (!waiting_.empty() && (waiting_.back().first > R || active_[waiting_.back().second])) {
    woke |= wake(waiting_.back().second);
    waiting_.pop_back();
  }
  return woke;
}

bool Activity::wake(std::int32_t particle) {
  if (active_[particle]) return false;
  active_[particle] = 1;
  list_.insert(std::lower_bound(list_.begin(), list_.end(), particle), particle);
  return true;
}

void Activity::fields(SavedFields& f) {
  std::vector<std::int32_t> awake = list_;
  f("awake", awake);
  for (const std::int32_t particle : awake) wake(particle);
}

}  // namespace crumble::dryer
