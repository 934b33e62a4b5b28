// Reference solver for the forces inside a rigid cluster: every contact is an elastic joint of six degrees of freedom,
// the loads of the fluid are spread by their stiffness (Vanni 2015). Dense, small clusters, tests only.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "clusters.hpp"

namespace crumble::testing {

// Stiffness of a joint for unit radii; forces in any unit, only ratios matter. Table 1 of the paper at a = 100 nm.
struct Joint {
  double normal, sliding, twisting, rolling;
};

Joint table_1_joint();

using Bonds = std::vector<std::pair<int, int>>;

Bonds touching_pairs(const Spheres& s, double tolerance = 1e-6);

// A dried cluster of tests/hydro/dried with its bonds.
struct DriedCluster {
  Spheres spheres;
  Bonds bonds;
};

DriedCluster dried_cluster(const std::string& name);

// Normal force (tension positive) of every bond, a row, for balanced six-vectors of loads, a column each.
Eigen::MatrixXd bond_tension(const Spheres& s, const Bonds& bonds, const Eigen::MatrixXd& loads,
                             const Joint& joint = table_1_joint());

// Largest tension of one bond over all orientations of planar elongation (or simple shear) of unit rate: the tension is
// A : E with A symmetric traceless, the rows of `by_strain` hold A in the strain basis, and the maximum over rotations
// is half the difference of the extreme eigenvalues.
double worst_orientation(const Eigen::MatrixXd& by_strain);

}  // namespace crumble::testing
