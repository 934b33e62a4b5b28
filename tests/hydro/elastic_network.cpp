#include "elastic_network.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "common/contact/jkr.hpp"
#include "common/contact/rolling.hpp"
#include "common/contact/sliding.hpp"
#include "common/contact/twisting.hpp"
#include "common/hydro/strain_basis.hpp"

namespace crumble::testing {

Joint table_1_joint() {
  const Material material;
  const double a = 1e-7, b0 = Jkr(material, a).zero_load_radius;
  const double normal = 1.8 * a * pull_off_force(material, a) / (b0 * b0);  // tangent of Eq. 10 at zero load
  return {normal, sliding_stiffness(material, a), twisting_stiffness(material, a) / (a * a),
          rolling_stiffness(material, a) / (a * a)};
}

Bonds touching_pairs(const Spheres& s, double tolerance) {
  Bonds bonds;
  for (int i = 0; i < s.size(); ++i)
    for (int j = i + 1; j < s.size(); ++j)
      if ((s.position[j] - s.position[i]).norm() < (s.radius[i] + s.radius[j]) * (1 + tolerance))
        bonds.emplace_back(i, j);
  return bonds;
}

DriedCluster dried_cluster(const std::string& name) {
  std::ifstream file(CRUMBLE_SOURCE_DIR "/tests/hydro/dried/" + name + ".txt");
  std::string comment;
  std::getline(file, comment);
  std::getline(file, comment);
  std::size_t n = 0, bonds = 0;
  file >> n >> bonds;
  std::vector<Vector3> x(n);
  DriedCluster cluster;
  cluster.bonds.resize(bonds);
  for (auto& p : x) file >> p[0] >> p[1] >> p[2];
  for (auto& [i, j] : cluster.bonds) file >> i >> j;
  if (!file) throw std::runtime_error("cannot read the dried cluster " + name);
  cluster.spheres = unit_spheres(x);
  return cluster;
}

Eigen::MatrixXd bond_tension(const Spheres& s, const Bonds& bonds, const Eigen::MatrixXd& loads, const Joint& joint) {
  const int n = s.size();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  std::vector<Eigen::RowVectorXd> stretch;
  for (const auto& [i, j] : bonds) {
    const Vector3 normal = (s.position[j] - s.position[i]).normalized();
    Eigen::Matrix3d cross;  // v -> n x v
    cross << 0, -normal.z(), normal.y(), normal.z(), 0, -normal.x(), -normal.y(), normal.x(), 0;
    // Relative displacement at the contact, u_j - u_i - (a_i theta_i + a_j theta_j) x n, and relative rotation.
    Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(3, 6 * n), turn = shift;
    shift.middleCols<3>(6 * i) = -Eigen::Matrix3d::Identity();
    shift.middleCols<3>(6 * j).setIdentity();
    shift.middleCols<3>(6 * i + 3) = s.radius[i] * cross;
    shift.middleCols<3>(6 * j + 3) = s.radius[j] * cross;
    turn.middleCols<3>(6 * i + 3) = -Eigen::Matrix3d::Identity();
    turn.middleCols<3>(6 * j + 3).setIdentity();
    const Eigen::Matrix3d along = normal * normal.transpose(), across = Eigen::Matrix3d::Identity() - along;
    K += shift.transpose() * (joint.normal * along + joint.sliding * across) * shift +
         turn.transpose() * (joint.twisting * along + joint.rolling * across) * turn;
    stretch.push_back(joint.normal * normal.transpose() * shift);
  }
  // Rigid motions cost nothing: hold them by stiffness of their own; balanced loads do not stretch it.
  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(6 * n, 6);
  for (int i = 0; i < n; ++i) {
    const Vector3 x = s.position[i];
    Z.block<6, 6>(6 * i, 0).setIdentity();
    Z.block<3, 3>(6 * i, 3) << 0, x.z(), -x.y(), -x.z(), 0, x.x(), x.y(), -x.x(), 0;
  }
  K += joint.normal * Z * (Z.transpose() * Z).inverse() * Z.transpose();
  const Eigen::MatrixXd displacement = K.llt().solve(loads);
  Eigen::MatrixXd tension(static_cast<Eigen::Index>(bonds.size()), loads.cols());
  for (std::size_t b = 0; b < bonds.size(); ++b) tension.row(static_cast<Eigen::Index>(b)) = stretch[b] * displacement;
  return tension;
}

double worst_orientation(const Eigen::MatrixXd& by_strain) {
  double worst = 0;
  for (Eigen::Index b = 0; b < by_strain.rows(); ++b) {
    const Vector5 a = by_strain.row(b).transpose();
    const Vector3 eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(strain_tensor(a)).eigenvalues();
    worst = std::max(worst, 0.5 * (eigenvalues[2] - eigenvalues[0]));
  }
  return worst;
}

}  // namespace crumble::testing
