// A cluster that moves as one rigid body: loads on every sphere for any motion and any linear flow, from one solve.
#pragma once

#include "common/hydro/hydrodynamics.hpp"
#include "common/numerics/saved_fields.hpp"

namespace crumble {

// Everything is linear, so eleven right-hand sides (6 rigid motions, 5 strains) hold every answer. SI units; loads by
// the fluid on the spheres (six-vectors of hydrodynamics.hpp, torques about each sphere's centre).
struct RigidBodyResponse {
  Vector3 centre = Vector3::Zero();         // the point whose velocity is U
  Eigen::MatrixXd motion_loads;             // 6N x 6: by unit (U, Omega) relative to the ambient flow at the centre
  Eigen::MatrixXd strain_loads;             // 6N x 5: by unit strains, the body resting relative to that flow
  Eigen::Matrix<double, 6, 6> drag;         // (F, T about the centre) on the body = -drag (U, Omega); SPD
  Eigen::Matrix<double, 6, 5> strain_drag;  // the same on the body by unit strains
  Eigen::Matrix<double, 6, 5> drift;        // (U, Omega) of the free body relative to the ambient flow, unit strains
  Eigen::MatrixXd free_loads;               // 6N x 5: loads on the spheres of the free body, unit strains; sum zero

  // Loads on every sphere of the body that nothing else holds, and its motion, in a linear flow.
  Eigen::VectorXd loads(const LinearFlow& flow) const { return free_loads * flow.strain(); }
  Eigen::Matrix<double, 6, 1> motion(const LinearFlow& flow) const;
  void fields(SavedFields& f);
};

RigidBodyResponse rigid_body_response(const Hydrodynamics& hydrodynamics, const std::vector<Vector3>& position,
                                      const Vector3& centre);

}  // namespace crumble
