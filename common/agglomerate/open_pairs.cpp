#include "common/agglomerate/open_pairs.hpp"

#include <algorithm>

namespace crumble {

void erase_bonded(std::vector<Pair>& pairs, const std::vector<Contact>& bonds) {
  auto bond = bonds.begin();
  std::erase_if(pairs, [&](const Pair& pair) {
    while (bond != bonds.end() && Pair{bond->i, bond->j} < pair) ++bond;
    return bond != bonds.end() && Pair{bond->i, bond->j} == pair;
  });
}

void OpenPairs::update(const std::vector<Vector3>& position, const std::vector<double>& radius,
                       const std::vector<Contact>& bonds) {
  if (reference_.size() == position.size()) {
    const double limit = 0.25 * (skin_ - complete_) * (skin_ - complete_);
    bool moved = false;
    for (std::size_t p = 0; p < position.size() && !moved; ++p)
      moved = !((position[p] - reference_[p]).squaredNorm() < limit);
    if (!moved) return;
  }
  reference_ = position;
  search_.find(position, radius, skin_, pairs_);
  erase_bonded(pairs_, bonds);
}

void OpenPairs::open(Pair pair) { pairs_.insert(std::lower_bound(pairs_.begin(), pairs_.end(), pair), pair); }

void OpenPairs::close(Pair pair) {
  const auto place = std::lower_bound(pairs_.begin(), pairs_.end(), pair);
  if (place != pairs_.end() && *place == pair) pairs_.erase(place);
}

}  // namespace crumble
