// Forces between near surfaces of a moving agglomerate.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/agglomerate/bond_increment.hpp"
#include "common/agglomerate/open_pairs.hpp"
#include "common/surface_forces/pair_forces.hpp"

namespace crumble::breaker {

// All pairs within the range of the forces, bonded or not, in a liquid that stays as it is. Increments q = (dx_i, ...),
// six a particle, as everywhere here; forces are along the line of centres.
class SurfacePairs {
 public:
  SurfacePairs(const SurfaceForces& forces, const BondLaws& contacts, const std::vector<double>& radius);

  // After the frame has moved or its contacts have changed. Complete for increments of up to a tenth of a radius.
  void update(const Frame& frame);

  void add_loads(const Frame& frame, Eigen::VectorXd& loads) const;   // (F_i, ...), N
  double energy(const Frame& frame, const Eigen::VectorXd& q) const;  // J
  void add_gradient(const Frame& frame, const Eigen::VectorXd& q, Eigen::VectorXd& gradient) const;
  // Blocks of the lower triangle, N/m.
  void add_stiffness(const Frame& frame, const Eigen::VectorXd& q, Curvature curvature, Eigen::MatrixXd& matrix) const;

  const SurfaceForceLaws& laws() const { return laws_; }
  std::size_t size() const { return pairs_.size(); }

 private:
  struct Near {
    std::int32_t i, j;
    bool bonded;
  };
  struct Apart {
    Vector3 normal;
    double distance, gap;
  };
  Apart apart(const Frame& frame, const Near& pair, const Eigen::VectorXd* q) const;
  double tension(const Near& pair, double gap) const;

  const std::vector<double>& radius_;
  SurfaceForceLaws laws_;
  OpenPairs list_;
  std::vector<Near> pairs_;
};

}  // namespace crumble::breaker
