// One implicit step of a flexible agglomerate: where drag, load of the flow and contacts balance at its end.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "breaker/surface_pairs.hpp"
#include "common/agglomerate/bond_increment.hpp"
#include "common/contact/bond_laws.hpp"

namespace crumble::breaker {

// The minimum over the increments q = (dx_i, L dtheta_i) of all spheres of
//
//   (drag/2) q^T R q - f^T q + sum over bonds (U_normal(gap) + U_sliding + U_twisting + U_rolling),
//
// with drag = 1/dt and f the load of the flow: backward Euler for R dq/dt = f + contact loads, the plastic springs
// mapped back onto their limits. The normal energy ends at the pull-off gap, so that the minimum is a local one: the
// first that is met going downhill from the increments at the start. Newton's method with a line search on the energy;
// R is dense, so a factor is one of order 6N: it is kept over the iterations of a step while corrections fall tenfold.
class ImplicitStep {
 public:
  // surface_pairs: forces between near surfaces, whose energies are added; nullptr: none.
  ImplicitStep(const std::vector<double>& radius, double length, const BondLaws& laws,
               const SurfacePairs* surface_pairs = nullptr);

  struct Problem {
    const Eigen::MatrixXd& resistance;  // R, N s/m, both triangles
    double drag;                        // 1/s
    Eigen::VectorXd load;               // f = (F_i, T_i/L), N
  };
  struct Outcome {
    bool converged = false;
    int iterations = 0, factorisations = 0;
  };
  // Starts from q as it stands: the nearer it is to where the step ends, the better are the frames of the contacts,
  // which are those foreseen for it. tolerance: of the last correction, m.
  Outcome solve(const Frame& frame, const Problem& problem, double tolerance, Eigen::VectorXd& q);

 private:
  const std::vector<double>& radius_;
  double length_;
  const BondLaws& laws_;
  const SurfacePairs* surface_pairs_;
  std::vector<Contact> bonds_;  // foreseen for the end of the step
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd gradient_, correction_, dragged_, dragged_correction_, trial_;

  BondEnds ends(const Contact& bond) const;
  BondIncrement increment(const Frame& frame, const Contact& bond, const Eigen::VectorXd& q) const;
  void foresee(const Frame& frame, const Eigen::VectorXd& q);
  double bond_energy(const Frame& frame, const Eigen::VectorXd& q) const;
  void set_gradient(const Frame& frame, const Problem& problem, const Eigen::VectorXd& q);
  bool factorise(const Frame& frame, const Problem& problem, const Eigen::VectorXd& q, Curvature curvature);
};

}  // namespace crumble::breaker
