// One implicit step of overdamped motion: where drag, capillary force and contacts balance at the end of the step.
#pragma once

#include "common/agglomerate/bond_increment.hpp"
#include "common/contact/bond_laws.hpp"
#include "dryer/block_cholesky.hpp"
#include "dryer/model.hpp"

namespace crumble::dryer {

// Backward Euler for zeta dx/dt = F(x), zeta_r dtheta/dt = T, written as the minimum of
//
//   sum over particles  zeta |dx|^2/(2 dt) + zeta_r |dtheta|^2/(2 dt) + U_capillary(|x + dx|; R at the end)
//   + sum over bonds    U_normal(gap) + U_sliding(|xi|) + U_twisting(|phi|) + U_rolling(|theta|)
//
// The spring energies turn from quadratic to linear at their limits; their gradient is the capped force and the minimum
// is the return mapping of perfect plasticity (Simo & Hughes 1998). Newton's method with a line search on the energy,
// which therefore never rises; terms of negative curvature are left out of the matrix, so it is positive definite for
// every step length. Tangential motion is measured at the normals of the start of the step: first order in dt, as
// backward Euler is. Limits that depend on load are those of the start of the step. So is, at the predicted position,
// the capillary force on a particle that is more than half out of the liquid, and on any while R < a: it falls as the
// particle moves out, which an explicit force follows without harm and Newton's method does not.
class ImplicitStep {
 public:
  ImplicitStep(const DryingModel& model, const Agglomerate& state, const BondLaws& laws);

  // Which particles move; call again whenever the bonds or the active particles change.
  void set_network(const std::vector<std::int32_t>& active);

  struct Outcome {
    bool converged = false;
    int iterations = 0;
  };
  // Solves for the increments from the present state over dt, the front at R at the end; starts from the increments as
  // they stand. tolerance: largest last correction of Newton's method, m.
  Outcome solve(double dt, double R, double tolerance);

  // Per active particle: translation (m) and rotation times radius (m).
  std::vector<Vector6>& increments() { return increment_; }
  const std::vector<Vector6>& increments() const { return increment_; }
  // Of any particle: those that set_network() was not told of stand still.
  Vector3 translation(std::int32_t particle) const;
  Vector3 rotation(std::int32_t particle) const;  // rad

 private:
  double surface_energy(std::size_t k, const Vector3& translation) const;
  void choose_surface_forces();
  double energy(const std::vector<Vector6>& q) const;
  void linearise(const std::vector<Vector6>& q);
  void linearise_particle(std::size_t k, const Vector6& q);
  void linearise_bond(std::size_t b, const std::vector<Vector6>& q);
  BondIncrement moved(const Contact& bond, const std::vector<Vector6>& q) const;

  const DryingModel& model_;
  const Agglomerate& state_;
  const BondLaws& laws_;
  double dt_ = 0, R_ = 0;
  std::vector<std::int32_t> active_, slot_;  // slot_: particle -> index among the active, or -1
  std::vector<Vector6> increment_, gradient_, correction_, trial_;
  std::vector<char> implicit_surface_;  // whether the capillary force is that at the end of the step
  std::vector<Vector3> held_;           // else the force held during the step, N
  std::vector<double> depth_;           // immersion of the surface at the last iterate, per active particle
  BlockCholesky matrix_;
};

}  // namespace crumble::dryer
