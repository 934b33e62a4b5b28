// Loads of the contacts against statics, whatever the stiffnesses.
#include "common/rigid/network.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace crumble {
namespace {

using testing::network;

// Random loads whose sum and moment vanish: the last words balance on the three first particles of any shape.
Eigen::MatrixXd balanced_loads(const Network& net, int columns = 3) {
  const int n = net.size();
  Eigen::MatrixXd load(6 * n, columns);
  for (Eigen::Index r = 0; r < load.rows(); ++r)
    for (Eigen::Index c = 0; c < columns; ++c) {
      const double scale = r % 6 < 3 ? 1 : testing::radius;
      load(r, c) =
          scale * random_normals(7, Purpose::radius, static_cast<std::uint32_t>(r), static_cast<std::uint64_t>(c))[0];
    }
  for (int c = 0; c < columns; ++c) {
    Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
    for (int i = 0; i < n; ++i) {
      force += load.block<3, 1>(6 * i, c);
      torque += load.block<3, 1>(6 * i + 3, c) + net.position()[i].cross(Vector3(load.block<3, 1>(6 * i, c)));
    }
    const Vector3 x = net.position()[0];
    load.block<3, 1>(0, c) -= force;
    load.block<3, 1>(3, c) -= torque - x.cross(force);
  }
  return load;
}

// Load on j from everything on j's side of contact b: sums along the chain, no stiffness anywhere.
Eigen::MatrixXd chain_statics(const Network& net, const Eigen::MatrixXd& load) {
  const auto bonds = static_cast<int>(net.joints().size());
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6 * bonds, load.cols());
  for (int b = 0; b < bonds; ++b)
    for (int i = b + 1; i < net.size(); ++i)
      for (int c = 0; c < load.cols(); ++c) {
        const Vector3 force = load.block<3, 1>(6 * i, c), arm = net.position()[i] - net.contact_point(b);
        expected.block<3, 1>(6 * b, c) -= force;
        expected.block<3, 1>(6 * b + 3, c) -= Vector3(load.block<3, 1>(6 * i + 3, c)) + arm.cross(force);
      }
  return expected;
}

// Forces and moments over the radius have one size.
double largest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd d = a - b;
  for (Eigen::Index r = 3; r < d.rows(); r += 6) d.middleRows(r, 3) /= testing::radius;
  return d.cwiseAbs().maxCoeff();
}

TEST(Network, ChainOf50AgreesWithStaticsToRoundOff) {
  for (const double bending : {1.0, 1e-6, 1e6}) {
    const Network net = network(testing::chain(50), {NormalStiffness::tangent, 1, bending});
    const Eigen::MatrixXd load = balanced_loads(net);
    const BondLoads found = net.solve(load);
    const Eigen::MatrixXd expected = chain_statics(net, load);
    // The moments in the middle are of order 50^1.5 times a load: relative to them 1e-10 is far above round-off.
    EXPECT_LT(largest_difference(found.load, expected), 1e-10 * expected.cwiseAbs().maxCoeff());
    EXPECT_LT(found.residual, 1e-12);
    EXPECT_EQ(net.bridges(), 49);
  }
}

// The elastic solver itself, on a chain that closes to a ring by one very soft contact: it
// must give what statics gives for the open chain, but for the share that the soft contact takes.
TEST(Network, RingWithAVerySoftContactBearsLoadsAsTheOpenChain) {
  const int n = 12;
  std::vector<Vector3> position;
  const double R = 1 / std::sin(std::numbers::pi / n);
  for (int i = 0; i < n; ++i)
    position.emplace_back(R * std::cos(2 * std::numbers::pi * i / n), R * std::sin(2 * std::numbers::pi * i / n), 0);
  const testing::Cluster ring = testing::touching(position);
  const Network hard = network(ring);
  std::vector<Joint> joints = hard.joints();
  ASSERT_EQ(joints.size(), 12u);
  EXPECT_EQ(hard.bridges(), 0);
  Joint& soft = joints[1];  // 0-11: the first is 0-1
  ASSERT_EQ(soft.j, 11);
  soft = {0, 11, 1e-13 * soft.normal, 1e-13 * soft.sliding, 1e-13 * soft.twisting, 1e-13 * soft.bending};
  const Network net(hard.position(), hard.radius(), joints);
  std::vector<Joint> open_joints = joints;
  open_joints.erase(open_joints.begin() + 1);
  const Network open(hard.position(), hard.radius(), open_joints);
  const Eigen::MatrixXd load = balanced_loads(net);
  const BondLoads closed = net.solve(load), statics = open.solve(load);
  Eigen::MatrixXd rest(statics.load.rows(), load.cols());
  rest << closed.load.topRows(6), closed.load.bottomRows(60);
  // A chain of 12 is some 1e6 times softer than a contact: the soft one takes 1e-13 times that.
  EXPECT_LT(largest_difference(rest, statics.load), 1e-6);
  EXPECT_LT(closed.residual, 1e-12);
}

TEST(Network, HyperstaticLoadsBalanceEveryParticleToRoundOff) {
  for (const auto& cluster : {testing::triangle(), testing::tetrahedron(), testing::octahedron(), testing::raft(6)}) {
    const Network net = network(cluster);
    const BondLoads found = net.solve(balanced_loads(net));
    EXPECT_LT(found.residual, 1e-13);
    EXPECT_LT(found.imbalance, 1e-15);
    EXPECT_TRUE(found.load.allFinite());
  }
}

TEST(Network, MinimisesElasticEnergyAmongBalancedLoads) {
  // Castigliano: of all loads in balance the elastic ones store least energy. Self-stresses of a triangle added to them
  // must cost energy in either direction.
  const Network net = network(testing::triangle());
  const Eigen::MatrixXd load = balanced_loads(net, 1);
  const Eigen::VectorXd found = net.solve(load).load;
  const auto energy = [&](const Eigen::VectorXd& l) {
    double sum = 0;
    for (int b = 0; b < 3; ++b) {
      const Vector3 n = net.normal(b), f = l.segment<3>(6 * b), m = l.segment<3>(6 * b + 3);
      const Joint& k = net.joints()[b];
      const double along = f.dot(n), twist = m.dot(n);
      sum += along * along / k.normal + (f.squaredNorm() - along * along) / k.sliding + twist * twist / k.twisting +
             (m.squaredNorm() - twist * twist) / k.bending;
    }
    return sum;
  };
  for (int b = 0; b < 3; ++b)
    for (int component = 0; component < 6; ++component) {
      // A unit load in contact b and what statics makes of it in the two others, cut open at b.
      std::vector<Joint> tree = net.joints();
      const Joint cut = tree[b];
      tree.erase(tree.begin() + b);
      const Network open(net.position(), net.radius(), tree);
      Eigen::Matrix<double, 6, 1> unit = Eigen::Matrix<double, 6, 1>::Zero();
      unit[component] = component < 3 ? 1 : testing::radius;
      Eigen::VectorXd on = Eigen::VectorXd::Zero(18);
      const Vector3 c = net.contact_point(b), f = unit.head<3>(), m = unit.tail<3>();
      on.segment<3>(6 * cut.j) += f;
      on.segment<3>(6 * cut.j + 3) += m + (c - net.position()[cut.j]).cross(f);
      on.segment<3>(6 * cut.i) -= f;
      on.segment<3>(6 * cut.i + 3) -= m + (c - net.position()[cut.i]).cross(f);
      const Eigen::VectorXd others = open.solve(on).load;
      Eigen::VectorXd self(18);
      for (int k = 0, o = 0; k < 3; ++k)
        if (k == b)
          self.segment<6>(6 * k) = unit;
        else
          self.segment<6>(6 * k) = others.segment<6>(6 * o++);
      const double slope = (energy(found + self) - energy(found - self)) / energy(self);
      EXPECT_NEAR(slope, 0, 1e-9) << b << " " << component;
    }
}

TEST(Network, NamesTheContactThatIsFreeToSwing) {
  try {
    network(testing::chain(3), {NormalStiffness::tangent, 1, 0});
    FAIL() << "a chain with free hinges is a mechanism";
  } catch (const Mechanism& error) {
    EXPECT_NE(std::string(error.what()).find("contact 0-1 is free to bend"), std::string::npos) << error.what();
  }
}

TEST(Network, NamesContactsOfAMechanismWithoutBridges) {
  // A ring of four joints that neither bend nor twist folds out of its plane and shears like a parallelogram.
  const testing::Cluster square = testing::touching({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  try {
    network(square, {NormalStiffness::tangent, 0, 0});
    FAIL() << "a ring of free hinges is a mechanism";
  } catch (const Mechanism& error) {
    EXPECT_NE(std::string(error.what()).find("mechanism"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("ing of "), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(network(square));
}

TEST(Network, TellsWhichParticleIsNotConnected) {
  testing::Cluster two = testing::chain(4);
  two.pairs = {{0, 1}, {2, 3}};
  try {
    network(two);
    FAIL() << "two fragments are not one body";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("particle 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace crumble
