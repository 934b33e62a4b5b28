// The network of bonds in a frame: carried along with the particles, made where two touch, lost beyond the reach of
// their law. Bonds are sorted by (i, j); `open` holds the near pairs that no bond joins.
#pragma once

#include <vector>

#include "common/agglomerate/bond.hpp"
#include "common/agglomerate/open_pairs.hpp"
#include "common/contact/bond_laws.hpp"

namespace crumble {

// advance() of bond.hpp. True if the bond is beyond its reach: its pair is open then, and drop_lost() takes it out.
bool advance_or_lose(Contact& bond, const BondLaw& law, const BondMotion& motion, OpenPairs& open);

void drop_lost(std::vector<Contact>& bonds);

// The open pairs whose surfaces touch, in order.
std::vector<Pair> touching(const OpenPairs& open, const std::vector<Vector3>& position,
                           const std::vector<double>& radius);

// Bonds an open pair where it stands, without history. The reference holds until the next bond is made or lost.
Contact& make_bond(Pair pair, const BondLaws& laws, const std::vector<double>& radius, Frame& frame, OpenPairs& open);

}  // namespace crumble
