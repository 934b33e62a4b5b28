#include "dryer/relaxation_rate.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Eigenvalues>

#include "common/agglomerate/bond.hpp"
#include "common/contact/bond_law.hpp"
#include "common/numerics/noise.hpp"
#include "dryer/drag.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

constexpr double viscosity = 1e-3;

struct Network {
  std::vector<Vector3> position;
  std::vector<double> radius;
  std::vector<Pair> pairs;

  void add(double r, const Vector3& x) {
    position.push_back(x);
    radius.push_back(r);
  }
};

// A lattice with every seventh bond left out, of spheres of two sizes.
Network lattice(int side) {
  Network n;
  const auto place = [side](int x, int y, int z) { return (z * side + y) * side + x; };
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) n.add((x + y + z) % 2 ? 8e-9 : 12e-9, 20e-9 * Vector3(x, y, z));
  int count = 0;
  const auto join = [&](int p, int q) {
    if (++count % 7) n.pairs.push_back({p, q});
  };
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        if (x + 1 < side) join(place(x, y, z), place(x + 1, y, z));
        if (y + 1 < side) join(place(x, y, z), place(x, y + 1, z));
        if (z + 1 < side) join(place(x, y, z), place(x, y, z + 1));
      }
  return n;
}

Network pair_of_spheres() {
  Network n;
  n.add(10e-9, Vector3::Zero());
  n.add(10e-9, Vector3(12e-9, 16e-9, 0));
  n.pairs.push_back({0, 1});
  return n;
}

struct Block {
  BondBlock bonds;
  Mobility mobility;
};

Block block_of(const Network& n) {
  Block made;
  made.bonds.clear(n.position.size());
  made.mobility.resize(n.position.size());
  for (std::size_t p = 0; p < n.position.size(); ++p) {
    made.mobility.translation[p] = static_cast<float>(1 / drag_coefficient(viscosity, n.radius[p]));
    made.mobility.rotation[p] = static_cast<float>(1 / rotational_drag_coefficient(viscosity, n.radius[p]));
  }
  for (const Pair& pair : n.pairs) {
    const double a_i = n.radius[pair.i], a_j = n.radius[pair.j];
    const BondLaw law(ContactChoice{}, Material{}, a_i, a_j);
    made.bonds.add(make_bond(law, pair.i, pair.j, n.position[pair.j] - n.position[pair.i], a_i, a_j, 0), pair.i, pair.j,
                   law, a_i, a_j, law.lost_gap());
  }
  made.bonds.find_stiffness();
  return made;
}

// The matrix of mobility times stiffness column by column, made symmetric.
Eigen::MatrixXd matrix(Block& block) {
  const std::size_t places = block.mobility.translation.size();
  Eigen::MatrixXd M(6 * places, 6 * places);
  for (std::size_t q = 0; q < places; ++q)
    for (std::size_t c = 0; c < 6; ++c) {
      std::vector<SixVector> ways(places);
      const std::size_t at = c < 3 ? c : c + 1;
      ways[q].at[at] = std::sqrt(block.mobility.of(q)[at]);
      block.bonds.respond(ways);
      for (std::size_t p = 0; p < places; ++p) {
        const Six load = block.bonds.load_on(p);
        for (std::size_t k = 0; k < 6; ++k) {
          const std::size_t row = k < 3 ? k : k + 1;
          M(6 * p + k, 6 * q + c) = -std::sqrt(static_cast<double>(block.mobility.of(p)[row])) * load[row];
        }
      }
    }
  return M;
}

double largest_eigenvalue(Block& block) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix(block), Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

TEST(BondSprings, are_the_derivative_of_an_energy) {
  Block block = block_of(lattice(3));
  const Eigen::MatrixXd M = matrix(block);
  EXPECT_LT((M - M.transpose()).norm(), 1e-5 * M.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues().minCoeff(),
            -1e-5 * M.norm());
}

// The loads of move() change by what the springs say.
TEST(BondSprings, are_the_slope_of_the_law) {
  const Network n = lattice(3);
  Block block = block_of(n);
  MotionBlock motion;
  motion.resize(n.position.size());
  for (std::size_t p = 0; p < n.position.size(); ++p) motion.position[p] = position(n.position[p]);
  block.bonds.advance(motion);
  block.bonds.find_stiffness();
  std::vector<Six> before;
  for (std::size_t p = 0; p < n.position.size(); ++p) before.push_back(block.bonds.load_on(p));
  std::vector<SixVector> ways;
  for (std::size_t p = 0; p < n.position.size(); ++p) {
    const auto x = random_normals(1, Purpose::start_position, static_cast<std::uint32_t>(p), 0),
               y = random_normals(1, Purpose::start_position, static_cast<std::uint32_t>(p), 1);
    // Small beside the range of the bond (0.2 nm), large beside the digits of single precision.
    const Vector6 way =
        (Vector6() << 2e-13 * x[0], 2e-13 * x[1], 2e-13 * x[2], 2e-5 * x[3], 2e-5 * y[0], 2e-5 * y[1]).finished();
    ways.push_back(six_vector(way));
    motion.moved[p] = ways.back();
    motion.position[p] = position(n.position[p] + way.head<3>());
  }
  block.bonds.advance(motion);
  std::vector<Six> after;
  for (std::size_t p = 0; p < n.position.size(); ++p) after.push_back(block.bonds.load_on(p));
  block.bonds.respond(ways);
  double force = 0, torque = 0;
  for (std::size_t p = 0; p < n.position.size(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      force = std::max(force, std::abs(static_cast<double>(block.bonds.load_on(p)[k])));
      torque = std::max(torque, std::abs(static_cast<double>(block.bonds.load_on(p)[4 + k])));
    }
  for (std::size_t p = 0; p < n.position.size(); ++p) {
    const Six change = after[p] - before[p], expected = block.bonds.load_on(p);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(change[k], expected[k], 0.03 * force) << p;
      EXPECT_NEAR(change[4 + k], expected[4 + k], 0.03 * torque) << p;
    }
  }
}

// The bound may be high by the share that makes it safe, 1/(1 - e): e is 0.056 to 0.065 for these.
TEST(RelaxationRate, bounds_the_largest_eigenvalue_from_above_and_not_far) {
  for (const Network& n : {pair_of_spheres(), lattice(2), lattice(4)}) {
    Block block = block_of(n);
    const double exact = largest_eigenvalue(block), bound = relaxation_rate(block.bonds, block.mobility);
    EXPECT_GT(bound, exact) << n.position.size();
    EXPECT_LT(bound, 1.08 * exact) << n.position.size();
  }
}

// The springs of one bond: along the normal 2 k_n/zeta, across it 3.5 k_s/zeta, since zeta_r = 4/3 a^2 zeta.
TEST(RelaxationRate, of_a_pair_is_that_of_its_springs) {
  const double a = 10e-9, zeta = drag_coefficient(viscosity, a);
  const BondLaw law(ContactChoice{}, Material{}, a, a);
  Block block = block_of(pair_of_spheres());
  EXPECT_NEAR(largest_eigenvalue(block) * zeta / std::max(2 * law.jkr.state(0).stiffness, 3.5 * law.k_s), 1, 1e-3);
}

TEST(RelaxationRate, without_bonds_is_zero) {
  Network n = pair_of_spheres();
  n.pairs.clear();
  Block block = block_of(n);
  EXPECT_EQ(relaxation_rate(block.bonds, block.mobility), 0);
}

TEST(RelaxationRate, is_the_same_on_any_number_of_threads) {
  const Network n = lattice(14);
  EXPECT_GT(n.position.size(), many);
  const auto bound = [&](int threads) {
    omp_set_num_threads(threads);
    Block block = block_of(n);
    const double found = relaxation_rate(block.bonds, block.mobility);
    omp_set_num_threads(1);
    return found;
  };
  const double one = bound(1);
  EXPECT_EQ(bound(2), one);
  EXPECT_EQ(bound(3), one);
}

// A step is made stable for the rate at its start and what has been added since: never too little.
TEST(RelaxationRate, grows_by_at_most_the_stiffening_of_a_place) {
  Network n = lattice(3);
  const std::vector<Pair> all = n.pairs;
  n.pairs.resize(all.size() - 5);
  Block block = block_of(n);
  const double before = largest_eigenvalue(block);
  block.bonds.remember_stiffness();
  for (std::size_t p = 0; p < n.position.size(); ++p)
    EXPECT_EQ(rate_increase(block.bonds, block.mobility, n.radius[p], p), 0);
  for (std::size_t b = n.pairs.size(); b < all.size(); ++b) {
    const auto [i, j] = all[b];
    const BondLaw law(ContactChoice{}, Material{}, n.radius[i], n.radius[j]);
    block.bonds.add(make_bond(law, i, j, n.position[j] - n.position[i], n.radius[i], n.radius[j], 0), i, j, law,
                    n.radius[i], n.radius[j], law.lost_gap());
  }
  double increase = 0;
  for (std::size_t p = 0; p < n.position.size(); ++p)
    increase = std::max(increase, rate_increase(block.bonds, block.mobility, n.radius[p], p));
  EXPECT_GT(increase, 0);
  EXPECT_LE(largest_eigenvalue(block), before + increase);
}

}  // namespace
