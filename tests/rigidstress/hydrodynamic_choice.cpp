// The choice of hydrodynamics and the error that it states.
#include "rigidstress/hydrodynamic_choice.hpp"

#include <gtest/gtest.h>

#include "common/io/errors.hpp"

#include "samples.hpp"

namespace crumble::rigidstress {
namespace {

const Say silent = [](const std::string&) {};

double largest(const Response& r) {
  return worst_contact(r.tension, std::vector<double>(r.tension.rows(), 1), planar_elongation(1).gradient).tension;
}

Judged judged(const Network& net, const HydrodynamicChoice& choice) {
  DoneParts parts;
  return judged_response(net, testing::centre(net.position()), choice, silent, parts);
}

HydrodynamicChoice with(Method method, int order = 3) {
  HydrodynamicChoice c;
  c.method = method;
  c.order = order;
  return c;
}

// Converged multipoles stand for the truth; their own error is 1e-3, a tenth of the tolerance.
TEST(HydrodynamicChoice, StatedErrorsCoverTheTrueOnes) {
  const std::vector<std::pair<testing::Cluster, int>> clusters{
      {testing::chain(2), 9},     {testing::chain(3), 8}, {testing::triangle(), 8}, {testing::tetrahedron(), 8},
      {testing::octahedron(), 7}, {testing::raft(3), 6},  {testing::chain(12), 5}};
  for (const auto& [cluster, converged] : clusters) {
    const Network net = testing::network(cluster);
    const double truth = largest(testing::response(net, {Rung::multipole, converged}));
    for (const Judged& found :
         {judged(net, {}), judged(net, with(Method::fts)), judged(net, with(Method::multipole, 2)),
          judged(net, with(Method::multipole, 3)), judged(net, with(Method::fts_relative_lubrication))}) {
      ASSERT_TRUE(found.error);
      EXPECT_LT(std::abs(largest(found.response) / truth - 1), *found.error + 1e-3)
          << cluster.position.size() << " spheres, " << found.method;
    }
    EXPECT_TRUE(judged(net, {}).within_tolerance);
    EXPECT_LE(*judged(net, {}).error, 0.01);
  }
}

TEST(HydrodynamicChoice, RelativeLubricationByTheFarFieldsSolutionIsTheFullOne) {
  const Network net = testing::network(testing::raft(3));
  HydroModel model{Rung::fts_relative_lubrication};
  const Response full = testing::response(net, model);
  const Judged fast = judged(net, with(Method::fts_relative_lubrication));
  // Lubrication loads are some hundred times the net ones and cancel: 1e-9 is their round-off.
  EXPECT_LT((full.tension - fast.response.tension).norm(), 1e-9 * full.tension.norm());
  EXPECT_LT((full.drag - fast.response.drag).norm(), 1e-9 * full.drag.norm());
}

TEST(HydrodynamicChoice, RefusesWhatDoesNotFitIntoMemoryAndSaysHowMuch) {
  const Network net = testing::network(testing::raft(3));
  HydrodynamicChoice c = with(Method::multipole, 4);
  c.memory = 1e6;
  try {
    judged(net, c);
    FAIL() << "9 spheres with 74 unknowns each take 3.5 MB";
  } catch (const TooLarge& error) {
    EXPECT_NE(std::string(error.what()).find("0.00355 GB"), std::string::npos) << error.what();
  }
  // The automatic choice stops where memory does and says that it is not within the tolerance.
  c.method = Method::automatic;
  const Judged found = judged(net, c);
  EXPECT_EQ(found.method, "multipole L = 2");
  EXPECT_FALSE(found.within_tolerance);
}

// Beyond the memory for a dense factor the far field iterates: same loads to its tolerance, in balance to round-off.
TEST(HydrodynamicChoice, IteratesWhereADenseFactorDoesNotFit) {
  const Network net = testing::network(testing::raft(6));
  HydrodynamicChoice c = with(Method::fts);
  const Judged dense = judged(net, c);
  c.memory = 1e5;
  const Judged iterated = judged(net, c);
  EXPECT_NE((dense.response.tension - iterated.response.tension).norm(), 0);
  EXPECT_LT((dense.response.tension - iterated.response.tension).norm(), 1e-4 * dense.response.tension.norm());
  EXPECT_LT((dense.response.drift - iterated.response.drift).norm(), 1e-5);
  EXPECT_LT(iterated.response.imbalance, 1e-14);
}

TEST(HydrodynamicChoice, WarnsOfLubricationOnCollectiveMotion) {
  std::string heard;
  const Network net = testing::network(testing::raft(2));
  DoneParts parts;
  judged_response(
      net, testing::centre(net.position()), with(Method::fts_lubrication),
      [&](const std::string& message) { heard += message; }, parts);
  EXPECT_NE(heard.find("warning"), std::string::npos);
}

// Spheres of 1 and 20 in touch: multipoles need no table of lubrication.
TEST(HydrodynamicChoice, RadiiBeyondTheTableOfLubricationAreForMultipolesAndRefusedByTheRest) {
  const double a = testing::radius;
  const Network net({Vector3::Zero(), Vector3(21 * a, 0, 0)}, {a, 20 * a},
                    {make_joint({}, Material{}, 0, 1, a, 20 * a)});
  const Judged multipole = judged(net, with(Method::multipole, 3));
  ASSERT_TRUE(multipole.error);
  EXPECT_EQ(multipole.how.find("lubrication"), std::string::npos) << multipole.how;
  const Judged far = judged(net, with(Method::fts));
  EXPECT_FALSE(far.error);
  EXPECT_NE(far.how.find("radii of near spheres"), std::string::npos) << far.how;
  for (const Method method : {Method::fts_lubrication, Method::fts_relative_lubrication}) {
    try {
      judged(net, with(method));
      FAIL() << "not refused";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("particles 0 and 1 have radii of 100 and 2000 nm, 20 to 1"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(HydrodynamicChoice, FewerOrdersWithoutAnEstimate) {
  HydrodynamicChoice c = with(Method::multipole, 3);
  c.estimate = false;
  EXPECT_FALSE(judged(testing::network(testing::chain(2)), c).error);
}

}  // namespace
}  // namespace crumble::rigidstress
