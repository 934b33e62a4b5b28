// Attraction of one pair at every gap: van der Waals before contact, the contact's own law in it.
#pragma once

#include "common/contact/bond_law.hpp"
#include "common/surface_forces/van_der_waals.hpp"

namespace crumble {

// Tension of a pair that is not bonded, with F_po and h_po the pull-off force and gap of its contact law N(h):
//   h > h_j          dV_A/dh
//   h_po < h <= h_j  that at h_j, which is F_po
//   h <= h_po        N(h)
// h_j is where dV_A/dh = F_po, for h << a and without retardation sqrt(A/(18 pi gamma_s)), whatever a. So force and
// energy are continuous, and a bond that lets go at h_po is still pulled by F_po: the normal force depends on the gap
// alone, and bonded and open pairs differ only in the springs of the contact. Where van der Waals forces are weaker
// than F_po at h_po already (large or soft particles), h_j = h_po and the force steps there from F_po to dV_A/dh; the
// energy is continuous still. A = 0: no attraction before contact at all, and the contact law acts on bonds alone.
// Gaps m, tension N (positive: attraction), energy J, zero far away.
class JoinedAttraction {
 public:
  JoinedAttraction() = default;
  JoinedAttraction(const VanDerWaals& outer, const BondLaw& contact);

  double tension(double gap) const;
  double energy(double gap) const;
  double joined_gap() const { return joined_gap_; }  // h_j
  double lost_gap() const { return contact_.lost_gap(); }
  // F_po - dV_A/dh at h_j, N: 0 where the force is continuous.
  double step() const;
  const VanDerWaals& outer() const { return outer_; }
  const BondLaw& contact() const { return contact_; }

 private:
  VanDerWaals outer_;
  BondLaw contact_;
  double joined_gap_ = 0;
};

}  // namespace crumble
