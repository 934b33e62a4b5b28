// The statically indeterminate parts of a network: displacement method with one sparse factor for all of them.
#pragma once

#include <memory>
#include <vector>

#include "common/numerics/sparse_cholesky.hpp"
#include "common/rigid/joint.hpp"

namespace crumble {

struct ElasticJoint {
  Joint joint;           // stiffnesses as forces for unit displacements (lengths in the mean radius)
  int row = 0;           // its number among all joints
  Vector3 normal;        // from i to j
  Vector3 arm_i, arm_j;  // from the centres to the contact point
};

struct ElasticInput {
  std::vector<ElasticJoint> joints;
  std::vector<int> block;  // of each particle
  int blocks = 0;
};

class ElasticBlocks {
 public:
  // Throws Mechanism, naming contacts, where free joints leave something to move.
  explicit ElasticBlocks(ElasticInput input);

  // Balances `load` (six rows a particle; sums to nothing over each block): adds the loads of the joints to their rows
  // of `bonds` and what they do to the particles to `load`, which ends near zero.
  void add_loads(Eigen::MatrixXd& load, Eigen::MatrixXd& bonds) const;

 private:
  using Sparse = SparseCholesky::Matrix;
  using Stiffness = Eigen::Matrix<double, 6, 6>;

  ElasticInput input_;
  std::vector<int> free_;         // first unknown of each particle; -1 where it is held or has none
  std::vector<bool> held_;        // the particle of its block that does not move
  std::vector<Stiffness> local_;  // D of each joint
  int unknowns_ = 0;
  std::unique_ptr<SparseCholesky> factor_;

  void number_unknowns();
  Sparse assemble() const;
  Eigen::MatrixXd joint_loads(const Eigen::MatrixXd& displacement, std::size_t joint) const;
  void refuse_mechanisms(const Sparse& stiffness) const;
};

}  // namespace crumble
