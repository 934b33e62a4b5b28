// Pairs that may touch soon.
#pragma once

#include <cstdint>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/numerics/neighbours.hpp"

namespace crumble {

// Leaves the pairs that no bond joins; both lists are sorted.
void erase_bonded(std::vector<Pair>& pairs, const std::vector<Contact>& bonds);

// Near pairs that are not bonded, sorted; found anew when something has moved so far that a pair with a gap below
// `complete` might be missing, m.
class OpenPairs {
 public:
  explicit OpenPairs(double skin, double complete = 0) : skin_(skin), complete_(complete) {}
  void update(const std::vector<Vector3>& position, const std::vector<double>& radius,
              const std::vector<Contact>& bonds);
  void open(Pair pair);
  void close(Pair pair);
  const std::vector<Pair>& pairs() const { return pairs_; }

 private:
  double skin_, complete_;
  NeighbourSearch search_;
  std::vector<Pair> pairs_;
  std::vector<Vector3> reference_;
};

}  // namespace crumble
