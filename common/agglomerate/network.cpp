#include "common/agglomerate/network.hpp"

#include <algorithm>

namespace crumble {

namespace {
constexpr std::int64_t lost = -1;  // in the place of the step at which a bond was made
}  // namespace

bool advance_or_lose(Contact& bond, const BondLaw& law, const BondMotion& motion, OpenPairs& open) {
  advance(bond, law, motion);
  if (bond.gap <= law.lost_gap()) return false;
  bond.born = lost;
  open.open({bond.i, bond.j});
  return true;
}

void drop_lost(std::vector<Contact>& bonds) {
  std::erase_if(bonds, [](const Contact& bond) { return bond.born == lost; });
}

std::vector<Pair> touching(const OpenPairs& open, const std::vector<Vector3>& position,
                           const std::vector<double>& radius) {
  std::vector<Pair> out;
  for (const Pair& pair : open.pairs()) {
    const double reach = radius[pair.i] + radius[pair.j];
    if ((position[pair.j] - position[pair.i]).squaredNorm() <= reach * reach) out.push_back(pair);
  }
  return out;
}

Contact& make_bond(Pair pair, const BondLaws& laws, const std::vector<double>& radius, Frame& frame, OpenPairs& open) {
  open.close(pair);
  const auto place =
      std::lower_bound(frame.contacts.begin(), frame.contacts.end(), pair, [](const Contact& bond, const Pair& other) {
        return Pair{bond.i, bond.j} < other;
      });
  return *frame.contacts.insert(
      place, make_bond(laws(pair.i, pair.j), pair.i, pair.j, frame.position[pair.j] - frame.position[pair.i],
                       radius[pair.i], radius[pair.j], frame.step));
}

}  // namespace crumble
