// The vectorised law of many bonds is that of the reference, bond by bond.
#include "dryer/bond_block.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "common/agglomerate/bond.hpp"
#include "common/numerics/noise.hpp"
#include "tests/dryer/samples.hpp"
#include "tests/seeds.hpp"

using namespace crumble;
using namespace crumble::dryer;
using namespace crumble::dryer::samples;

namespace {

constexpr double a = 10e-9;

TEST(BondBlock, is_the_law_of_the_reference) {
  const DryingModel model;
  const BondLaw law(model.contact, model.material, a, a);
  Agglomerate s = start(20, 100e-9, 3);
  BondBlock block;
  MotionBlock motion;
  motion.resize(20);
  block.clear(20);
  std::vector<Contact> bonds;
  // A chain at rest: 19 bonds, in three registers.
  const double pitch = 2 * a + law.equilibrium_gap();
  for (std::int32_t p = 0; p < 20; ++p) s.state.position[p] = Vector3(pitch * p, 0, 0);
  for (std::int32_t p = 0; p < 19; ++p) {
    bonds.push_back(make_bond(law, p, p + 1, s.state.position[p + 1] - s.state.position[p], a, a, 0));
    block.add(bonds.back(), p, p + 1, law, a, a, law.lost_gap());
  }
  const BondLaws laws(ContactChoice{}, Material{}, s.particles.radius);
  std::vector<std::int32_t> places(20);
  std::iota(places.begin(), places.end(), 0);
  std::vector<Contact> handed_back;
  std::size_t at_limit = 0, other_flags = 0;
  for (int step = 0; step < 200; ++step) {
    std::vector<Vector3> displacement(20), rotation(20);
    for (std::int32_t p = 0; p < 20; ++p) {
      const auto x = random_normals(seeded(1), Purpose::brownian_path, p, step),
                 y = random_normals(seeded(2), Purpose::radius, p, step);
      // Steps of 5 pm and 2 mrad about a place that pulls back, so that bonds live and springs yield.
      displacement[p] = 5e-12 * Vector3(x[0], x[1], x[2]) + 0.2 * (Vector3(pitch * p, 0, 0) - s.state.position[p]);
      rotation[p] = 2e-3 * Vector3(x[3], y[0], y[1]);
      s.state.position[p] += displacement[p];
      motion.position[p] = position(s.state.position[p]);
      motion.moved[p] = six_vector((Vector6() << displacement[p], rotation[p]).finished());
    }
    block.advance(motion);
    std::vector<Vector3> force(20, Vector3::Zero()), torque(20, Vector3::Zero());
    for (Contact& bond : bonds) {
      advance(bond, law,
              {s.state.position[bond.j] - s.state.position[bond.i], displacement[bond.j] - displacement[bond.i],
               rotation[bond.i], rotation[bond.j], a, a});
      at_limit += bond.at_limit != 0;
      force[bond.j] += force_on_j(bond);
      force[bond.i] -= force_on_j(bond);
      torque[bond.i] += torque_on_i(bond, lever_arm(bond, a, a));
      torque[bond.j] += torque_on_j(bond, lever_arm(bond, a, a));
    }
    ASSERT_TRUE(block.lost().empty());
    block.hand_back(places, laws, handed_back);
    for (std::size_t b = 0; b < bonds.size(); ++b) other_flags += handed_back[b].at_limit != bonds[b].at_limit;
    for (std::int32_t p = 0; p < 20; ++p) {
      const auto load = block.load_on(p);
      for (int k = 0; k < 3; ++k) {
        // Single precision: 1e-7 of the distance between centres is 7e-5 of the gap at pull-off.
        ASSERT_NEAR(load[k], force[p][k], 2e-4 * law.pull_off_force()) << step;
        ASSERT_NEAR(load[4 + k], torque[p][k], 2e-4 * law.pull_off_force() * a) << step;
      }
    }
  }
  EXPECT_GT(at_limit, 100u);  // springs did yield
  // The block tells it from springs that stand at their limits, to 1e-4: also those that have just come so near.
  EXPECT_LT(other_flags, at_limit / 50);
}

TEST(BondBlock, its_normal_force_is_that_of_the_law_from_pull_off_to_deep_compression) {
  const BondLaw law(ContactChoice{}, Material{}, a, a);
  for (double gap = 0.999 * law.lost_gap(); gap > -100 * law.jkr.length; gap -= 0.01 * law.jkr.length) {
    BondBlock block;
    MotionBlock motion;
    motion.resize(2);
    block.clear(2);
    block.add(make_bond(law, 0, 1, Vector3(2 * a, 0, 0), a, a, 0), 0, 1, law, a, a, law.lost_gap());
    motion.position[1].at[0] = 2 * a + gap;
    block.advance(motion);
    const double tension = law.jkr.tension(gap);
    // The polynomial's error, and rounding of the gap: 1e-7 of the distance is 7e-5 of the gap at pull-off.
    ASSERT_NEAR(-block.load_on(1)[0], tension, 2e-4 * std::max(std::abs(tension), law.pull_off_force())) << gap;
  }
}

TEST(BondBlock, a_bond_beyond_its_reach_is_named_and_pulls_no_more) {
  const BondLaw law(ContactChoice{}, Material{}, a, a);
  BondBlock block;
  MotionBlock motion;
  motion.resize(2);
  block.clear(2);
  block.add(make_bond(law, 0, 1, Vector3(2 * a, 0, 0), a, a, 0), 0, 1, law, a, a, law.lost_gap());
  motion.position[1].at[0] = 2 * a + 1.01 * law.lost_gap();
  block.advance(motion);
  EXPECT_EQ(block.lost(), std::vector<std::int32_t>{0});
  EXPECT_EQ(block.load_on(1)[0], 0);
}

TEST(BondBlock, a_bond_that_was_removed_counts_no_more_as_an_overlap) {
  const BondLaw law(ContactChoice{}, Material{}, a, a);
  BondBlock block;
  MotionBlock motion;
  motion.resize(3);
  block.clear(3);
  for (const std::int32_t p : {0, 1})
    block.add(make_bond(law, p, p + 1, Vector3(2 * a, 0, 0), a, a, 0), p, p + 1, law, a, a, law.lost_gap());
  motion.position[1].at[0] = 2 * a;
  motion.position[2].at[0] = 4 * a;
  block.remove(1);
  motion.position[2].at[0] = 3 * a;  // deep in the second one, which no bond tells of
  block.advance(motion);
  EXPECT_NEAR(block.deepest_overlap(), 0, 1e-6);
}

}  // namespace
