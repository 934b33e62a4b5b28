#include "common/surface_forces/joined_attraction.hpp"

#include <algorithm>
#include <cmath>

namespace crumble {

JoinedAttraction::JoinedAttraction(const VanDerWaals& outer, const BondLaw& contact)
    : outer_(outer), contact_(contact), joined_gap_(contact.lost_gap()) {
  if (outer.hamaker == 0 || outer.tension(joined_gap_) <= contact.pull_off_force()) return;
  // Falls with the gap.
  double low = joined_gap_, high = 2 * low;
  while (outer.tension(high) > contact.pull_off_force()) high *= 2;
  while (high - low > 1e-14 * high) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (outer.tension(middle) > contact.pull_off_force() ? low : high) = middle;
  }
  joined_gap_ = high;
}

double JoinedAttraction::tension(double gap) const {
  if (outer_.hamaker == 0) return 0;
  return gap > joined_gap_ ? outer_.tension(gap) : contact_.normal(gap).tension;
}

double JoinedAttraction::energy(double gap) const {
  if (outer_.hamaker == 0) return 0;
  if (gap > joined_gap_) return outer_.energy(gap);
  const double h_po = lost_gap(), held = contact_.pull_off_force() * (joined_gap_ - std::max(gap, h_po));
  const double inside = gap < h_po ? contact_.normal_energy(h_po) - contact_.normal_energy(gap) : 0;
  return outer_.energy(joined_gap_) - held - inside;
}

double JoinedAttraction::step() const {
  return outer_.hamaker == 0 ? 0 : contact_.pull_off_force() - outer_.tension(joined_gap_);
}

}  // namespace crumble
