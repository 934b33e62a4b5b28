#include "dryer/drying.hpp"

#include <algorithm>

namespace crumble {

BondLaws::BondLaws(const ContactChoice& choice, const Material& material, const std::vector<double>& radius)
    : choice_(choice),
      material_(material),
      radius_(radius),
      equal_(std::all_of(radius.begin(), radius.end(), [&](double a) { return a == radius.front(); })),
      shared_(choice, material, radius.front(), radius.front()) {}

const BondLaw& BondLaws::operator()(std::int32_t i, std::int32_t j) const {
  if (equal_) return shared_;
  const std::uint64_t key = static_cast<std::uint64_t>(i) << 32 | static_cast<std::uint32_t>(j);
  const auto found = pairs_.find(key);
  if (found != pairs_.end()) return found->second;
  return pairs_.emplace(key, BondLaw(choice_, material_, radius_[i], radius_[j])).first->second;
}

void OpenPairs::update(const std::vector<Vector3>& position, const std::vector<double>& radius,
                       const std::vector<Contact>& bonds) {
  if (reference_.size() == position.size()) {
    const double limit = 0.25 * skin_ * skin_;
    bool moved = false;
    for (std::size_t p = 0; p < position.size() && !moved; ++p)
      moved = !((position[p] - reference_[p]).squaredNorm() < limit);
    if (!moved) return;
  }
  ++searches_;
  reference_ = position;
  search_.find(position, radius, skin_, pairs_);
  auto bond = bonds.begin();  // both lists are sorted
  std::erase_if(pairs_, [&](const Pair& pair) {
    while (bond != bonds.end() && Pair{bond->i, bond->j} < pair) ++bond;
    return bond != bonds.end() && Pair{bond->i, bond->j} == pair;
  });
}

void OpenPairs::open(Pair pair) { pairs_.insert(std::lower_bound(pairs_.begin(), pairs_.end(), pair), pair); }

void OpenPairs::close(Pair pair) {
  const auto place = std::lower_bound(pairs_.begin(), pairs_.end(), pair);
  if (place != pairs_.end() && *place == pair) pairs_.erase(place);
}

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

double Activity::next_front() const {
  for (auto next = waiting_.rbegin(); next != waiting_.rend(); ++next)
    if (!active_[next->second]) return next->first;
  return 0;
}

bool Activity::wake(std::int32_t particle) {
  if (active_[particle]) return false;
  active_[particle] = 1;
  list_.insert(std::lower_bound(list_.begin(), list_.end(), particle), particle);
  return true;
}

}  // namespace crumble
