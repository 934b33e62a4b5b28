#include "common/rigid/network.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "common/rigid/elastic_blocks.hpp"

namespace crumble {

struct Network::Elastic {
  ElasticBlocks blocks;
};

namespace {

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// A free hinge that is a bridge lets one side swing.
void refuse_free_bridges(const std::vector<Joint>& joints, const NetworkTree& tree) {
  for (std::size_t b = 0; b < joints.size(); ++b) {
    if (!tree.bridge[b]) continue;
    const Joint& joint = joints[b];
    const std::string way = !(joint.normal > 0)     ? "stretch"
                            : !(joint.sliding > 0)  ? "slide"
                            : !(joint.bending > 0)  ? "bend"
                            : !(joint.twisting > 0) ? "twist"
                                                    : "";
    if (!way.empty())
      throw Mechanism("the contacts form a mechanism: contact " + std::to_string(joint.i) + "-" +
                      std::to_string(joint.j) + " is free to " + way +
                      " and nothing else holds its two sides together");
  }
}

Eigen::MatrixXd with_torques_scaled(Eigen::MatrixXd six, double factor) {
  for (Eigen::Index row = 3; row < six.rows(); row += 6) six.middleRows(row, 3) *= factor;
  return six;
}

}  // namespace

Network::Network(std::vector<Vector3> position, std::vector<double> radius, std::vector<Joint> joints)
    : position_(std::move(position)), radius_(std::move(radius)), joints_(std::move(joints)) {
  if (radius_.empty() || position_.size() != radius_.size())
    throw std::invalid_argument("network: one position for each of at least one radius is needed");
  length_ = mean(radius_);
  for (const Joint& joint : joints_)
    if (!(0 <= joint.i && joint.i < joint.j && joint.j < size()))
      throw std::invalid_argument("network: joint " + std::to_string(joint.i) + "-" + std::to_string(joint.j) +
                                  " is not 0 <= i < j < " + std::to_string(size()));
  tree_ = network_tree(size(), joints_);
  refuse_free_bridges(joints_, tree_);
  // Lengths in mean radii; stiffnesses as forces for unit displacement.
  ElasticInput input{.joints = {}, .block = tree_.block, .blocks = tree_.blocks};
  for (std::size_t b = 0; b < joints_.size(); ++b) {
    if (tree_.bridge[b]) continue;
    const Joint& joint = joints_[b];
    const Vector3 contact = contact_point(static_cast<int>(b));
    input.joints.push_back({joint, static_cast<int>(b), normal(static_cast<int>(b)),
                            (contact - position_[joint.i]) / length_, (contact - position_[joint.j]) / length_});
    input.joints.back().joint.twisting /= length_ * length_;
    input.joints.back().joint.bending /= length_ * length_;
  }
  elastic_ = std::make_unique<Elastic>(Elastic{ElasticBlocks(std::move(input))});
}

Network::~Network() = default;

Vector3 Network::normal(int joint) const {
  return (position_[joints_[joint].j] - position_[joints_[joint].i]).normalized();
}

Vector3 Network::contact_point(int joint) const {
  const auto [i, j] = std::pair(joints_[joint].i, joints_[joint].j);
  return position_[i] + radius_[i] / (radius_[i] + radius_[j]) * (position_[j] - position_[i]);
}

int Network::bridges() const {
  int count = 0;
  for (const bool bridge : tree_.bridge) count += bridge;
  return count;
}

// load += what the bonds do to the spheres (lengths in mean radii).
void Network::add_bond_loads(const Eigen::MatrixXd& bonds, Eigen::MatrixXd& load) const {
  for (int b = 0; b < static_cast<int>(joints_.size()); ++b) {
    const Vector3 contact = contact_point(b);
    const Vector3 arm_i = (contact - position_[joints_[b].i]) / length_;
    const Vector3 arm_j = (contact - position_[joints_[b].j]) / length_;
    for (Eigen::Index c = 0; c < load.cols(); ++c) {
      const Vector3 force = bonds.block<3, 1>(6 * b, c), moment = bonds.block<3, 1>(6 * b + 3, c);
      load.block<3, 1>(6 * joints_[b].j, c) += force;
      load.block<3, 1>(6 * joints_[b].j + 3, c) += moment + arm_j.cross(force);
      load.block<3, 1>(6 * joints_[b].i, c) -= force;
      load.block<3, 1>(6 * joints_[b].i + 3, c) -= moment + arm_i.cross(force);
    }
  }
}

// Everything beyond a bridge hangs on it: sums over the subtrees, torques about particle 0.
void Network::solve_bridges(const Eigen::MatrixXd& load, Eigen::MatrixXd& bonds) const {
  Eigen::MatrixXd sum = load;
  for (int i = 0; i < size(); ++i) {
    const Vector3 x = (position_[i] - position_[0]) / length_;
    for (Eigen::Index c = 0; c < load.cols(); ++c) sum.block<3, 1>(6 * i + 3, c) += x.cross(load.block<3, 1>(6 * i, c));
  }
  for (auto at = tree_.order.rbegin(); at != tree_.order.rend(); ++at) {
    const int i = *at, up = tree_.parent[i];
    if (up < 0) continue;
    const int b = tree_.parent_joint[i];
    if (tree_.bridge[b]) {
      const double sign = joints_[b].j == i ? -1 : 1;
      const Vector3 contact = (contact_point(b) - position_[0]) / length_;
      for (Eigen::Index c = 0; c < load.cols(); ++c) {
        const Vector3 force = sum.block<3, 1>(6 * i, c), torque = sum.block<3, 1>(6 * i + 3, c);
        bonds.block<3, 1>(6 * b, c) = sign * force;
        bonds.block<3, 1>(6 * b + 3, c) = sign * (torque - contact.cross(force));
      }
    }
    sum.middleRows(6 * up, 6) += sum.middleRows(6 * i, 6);
  }
}

BondLoads Network::solve(const Eigen::MatrixXd& load) const {
  if (load.rows() != 6 * size()) throw std::invalid_argument("network: six rows of loads for each particle are needed");
  const Eigen::MatrixXd given = with_torques_scaled(load, 1 / length_);
  BondLoads result;
  result.load = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(joints_.size()), load.cols());
  const double largest = given.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return result;

  Eigen::MatrixXd net = Eigen::MatrixXd::Zero(6, load.cols());
  double parts = 0;
  for (int i = 0; i < size(); ++i) {
    net += given.middleRows(6 * i, 6);
    const Vector3 x = (position_[i] - position_[0]) / length_;
    for (Eigen::Index c = 0; c < load.cols(); ++c) {
      const Vector3 force = given.block<3, 1>(6 * i, c);
      net.block<3, 1>(3, c) += x.cross(force);
      parts += (1 + x.norm()) * force.norm() + given.block<3, 1>(6 * i + 3, c).norm();
    }
  }
  result.imbalance = net.cwiseAbs().maxCoeff() / parts;

  solve_bridges(given, result.load);
  Eigen::MatrixXd unbalanced = given;
  add_bond_loads(result.load, unbalanced);
  elastic_->blocks.add_loads(unbalanced, result.load);
  unbalanced = given;
  add_bond_loads(result.load, unbalanced);
  result.residual = unbalanced.cwiseAbs().maxCoeff() / largest;
  result.load = with_torques_scaled(std::move(result.load), length_);
  return result;
}

}  // namespace crumble
