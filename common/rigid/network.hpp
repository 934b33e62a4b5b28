// How given loads on the spheres of a rigid agglomerate are spread over its contacts.
//
// Every contact is an elastic joint (joint.hpp). The agglomerate is free: loads must balance, and its six rigid motions
// cost nothing and are held at one particle, where no reaction arises. With u the displacements and rotations, B the
// relative displacement at the contact point and the relative rotation of each bond, D its stiffnesses and F the loads:
//     B^T D B u = F,   load of a bond on j at the contact point = -D B u                  (Vanni 2015, paper, 2.2)
// A bond without which the network would fall apart (bridges.hpp) is statically determinate: its load is the sum of
// the loads on one side, exactly, whatever the stiffnesses. Only what bridges leave over is elastic: one sparse
// Cholesky factor (CHOLMOD, METIS ordering), refined on the balance of the bond loads themselves, so that a ratio of
// stiffnesses of 1e6 does not spoil them.
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <stdexcept>

#include "common/rigid/bridges.hpp"

namespace crumble {

// Contacts that give way without any resistance, named.
struct Mechanism : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct BondLoads {
  Eigen::MatrixXd load;  // 6 rows a joint: force and moment on j at the contact point; columns as given
  double imbalance = 0;  // net load given, relative to the sum of its absolute parts: should be round-off
  double residual = 0;   // largest unbalanced load of a particle, relative to the largest load on one
};

class Network {
 public:
  // Positions and radii in m. Throws std::invalid_argument if the network is not connected, Mechanism if it can move.
  Network(std::vector<Vector3> position, std::vector<double> radius, std::vector<Joint> joints);
  ~Network();

  // Loads on the spheres, 6 rows each (force, N; torque about the sphere's centre, N m), as many columns as wanted.
  BondLoads solve(const Eigen::MatrixXd& load) const;

  const std::vector<Vector3>& position() const { return position_; }
  const std::vector<double>& radius() const { return radius_; }
  const std::vector<Joint>& joints() const { return joints_; }
  int size() const { return static_cast<int>(radius_.size()); }
  Vector3 normal(int joint) const;         // unit vector from i to j
  Vector3 contact_point(int joint) const;  // m; divides the distance of centres in the ratio of the radii
  int bridges() const;                     // joints that statics alone determines

 private:
  struct Elastic;  // factor of the parts between bridges
  std::vector<Vector3> position_;
  std::vector<double> radius_;
  std::vector<Joint> joints_;
  double length_ = 1;  // mean radius: torques are divided by it, so that all six equations have one size
  NetworkTree tree_;
  std::unique_ptr<Elastic> elastic_;

  void add_bond_loads(const Eigen::MatrixXd& bonds, Eigen::MatrixXd& load) const;
  void solve_bridges(const Eigen::MatrixXd& load, Eigen::MatrixXd& bonds) const;
};

}  // namespace crumble
