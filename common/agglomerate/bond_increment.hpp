// What one implicit step needs of a bond: energy, forces and stiffness under increments of its two spheres.
#pragma once

#include "common/agglomerate/bond.hpp"

namespace crumble {

// Compression across the normal softens a bond: the second derivatives with that part or, positive semi-definite,
// without.
enum class Curvature { full, convex };

// Increments of one sphere: (dx, scale * dtheta), m. With rotations stored as lengths all stiffnesses are N/m.
struct BondEnds {
  double radius_i, radius_j;  // m
  double scale_i, scale_j;    // m
};

// A bond as it would be after the increments, its springs not yet yielded. Tangential motion is measured at the bond's
// own normal, the limit of sliding at its own tension: those before the increments, which is of first order in the
// step, or those of foreseen(). `advance` of bond.hpp then moves the bond exactly.
class BondIncrement {
 public:
  BondIncrement(const Contact& bond, const BondLaw& law, const BondEnds& ends, const Vector3& separation,
                const Vector6& q_i, const Vector6& q_j);

  double gap() const { return gap_; }  // m
  bool lost() const { return gap_ > law_.lost_gap(); }

  // Normal energy plus the capped energies of the three springs, J: convex but for the end of the normal force. Its
  // minimum together with a dissipation is the implicit step with return mapping (Simo & Hughes 1998).
  double energy() const;

  // Adds the gradient of the energy, N; K: second derivatives, N/m.
  void add_gradient(Vector6& g_i, Vector6& g_j) const;
  void stiffness(Matrix6& K_ii, Matrix6& K_ij, Matrix6& K_jj, Curvature curvature = Curvature::convex) const;

 private:
  const BondLaw& law_;
  const Contact& bond_;
  Vector3 n_;  // after the increments
  double distance_, gap_;
  Vector3 sliding_, rolling_;
  double twisting_, sliding_limit_;
  double c_i_, c_j_, scale_i_, scale_j_;  // lever arms over scales
};

// The bond as it will stand if its spheres move by these increments. A BondIncrement of it has the normal and tension
// of the end of the step and, at these increments, the springs that carry() of bond.hpp finds: for increments near by
// it is of second order. Beyond its reach the tension is that of pull-off.
Contact foreseen(const Contact& bond, const BondLaw& law, const BondEnds& ends, const Vector3& separation,
                 const Vector6& q_i, const Vector6& q_j);

}  // namespace crumble
