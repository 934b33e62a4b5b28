#include "common/agglomerate/closing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "common/contact/jkr.hpp"
#include "tests/agglomerate/shapes.hpp"

namespace crumble {
namespace {

constexpr double a = 10e-9;
const Material table_1;

// A tree grown in space: every sphere touches one earlier sphere at a random place and misses all others, or is tried
// again. Gaps are then disturbed by up to `disturbance` of a radius.
struct Grown {
  Particles particles;
  Frame frame;
};
Grown random_tree(std::size_t count, double smallest, double largest, double disturbance, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  Grown g{shapes::equal_spheres(count, a), {}};
  g.particles.radius[0] = smallest;
  g.frame.position.push_back(Vector3::Zero());
  while (g.frame.position.size() < count) {
    const std::size_t next = g.frame.position.size();
    const double radius = smallest + (largest - smallest) * unit(engine);
    const auto parent = static_cast<std::size_t>(unit(engine) * static_cast<double>(next));
    const Vector3 out = Vector3(normal(engine), normal(engine), normal(engine)).normalized();
    const double reach = g.particles.radius[parent] + radius * (1 + disturbance * (2 * unit(engine) - 1));
    const Vector3 x = g.frame.position[parent] + reach * out;
    bool free = true;
    for (std::size_t k = 0; k < next && free; ++k) {
      free = k == parent || (x - g.frame.position[k]).norm() > 1.2 * (radius + g.particles.radius[k]);
    }
    if (!free) continue;
    g.particles.radius[next] = radius;
    g.frame.position.push_back(x);
    g.frame.contacts.push_back({.i = static_cast<std::int32_t>(parent), .j = static_cast<std::int32_t>(next)});
  }
  return g;
}

double worst_residual(const Particles& p, const Frame& f) {
  double worst = 0;
  for (const Contact& c : f.contacts) {
    const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
    const Jkr law(table_1, pair_radius(p.radius[i], p.radius[j]));
    const double gap = (f.position[j] - f.position[i]).norm() - p.radius[i] - p.radius[j];
    worst = std::max(worst, std::abs(gap - law.equilibrium_gap));
  }
  return worst;
}

TEST(Closing, APairEndsAtTheEquilibriumGapAroundItsOldCentre) {
  const Particles p = shapes::equal_spheres(2, a);
  const Closed closed =
      close_contacts(p, shapes::frame({{1e-6, 0, 0}, {1e-6, 2.02 * a, 0}}, {{.i = 0, .j = 1}}), table_1);
  const Jkr law(table_1, a);
  ASSERT_EQ(closed.frame.contacts.size(), 1u);
  EXPECT_NEAR(closed.frame.contacts[0].gap, law.equilibrium_gap, 1e-12 * a);
  EXPECT_NEAR(closed.frame.contacts[0].normal.y(), 1, 1e-15);
  EXPECT_NEAR(closed.frame.position[0].y() + closed.frame.position[1].y(), 2.02 * a, 1e-12 * a);
  EXPECT_NEAR(closed.largest_move, (0.02 * a - law.equilibrium_gap) / 2, 1e-12 * a);
  EXPECT_TRUE(closed.converged);
}

TEST(Closing, TreesAreClosedToRoundOff) {
  for (unsigned seed : {1u, 2u, 3u}) {
    const Grown g = random_tree(400, a, a, 0.02, seed);
    ASSERT_GT(worst_residual(g.particles, g.frame), 0.02 * a);
    const Closed closed = close_contacts(g.particles, g.frame, table_1);
    EXPECT_LT(worst_residual(g.particles, closed.frame), 1e-12 * a);
    EXPECT_LT(closed.tension_rms, 1e-9);  // k_n a / F_po = 138 at this size times the gap's round-off
    EXPECT_EQ(closed.frame.contacts.size(), g.frame.contacts.size());
    EXPECT_TRUE(closed.lost.empty());
  }
}

TEST(Closing, TreesOfRadiiDifferingByTenAreClosedToRoundOff) {
  const Grown g = random_tree(400, a, 10 * a, 0.02, 4);
  const Closed closed = close_contacts(g.particles, g.frame, table_1);
  EXPECT_LT(worst_residual(g.particles, closed.frame), 1e-12 * a);
}

TEST(Closing, AStraightChainOfThousandsIsClosedToRoundOff) {
  const std::size_t count = 5001;
  const Particles p = shapes::equal_spheres(count, a);
  const Closed closed =
      close_contacts(p, shapes::frame(shapes::chain(count, 2.01 * a), shapes::chain_contacts(count)), table_1);
  // Coordinates of 5e3 a carry 1e-12 a of round-off each.
  EXPECT_LT(worst_residual(p, closed.frame), 3e-12 * a);
  EXPECT_TRUE(closed.converged);
}

TEST(Closing, IsostaticOctahedronIsClosedToRoundOff) {
  std::vector<Vector3> x{{1, 0, 0}, {-1, 0, 0}, {0, 1.02, 0}, {0, -1, 0}, {0.01, 0, 1}, {0, -0.02, -1}};
  for (Vector3& v : x) v *= std::sqrt(2.0) * a;
  std::vector<Contact> contacts;
  for (std::int32_t i = 0; i < 6; ++i)
    for (std::int32_t j = i + 1; j < 6; ++j)
      if (i / 2 != j / 2) contacts.push_back({.i = i, .j = j});
  const Particles p = shapes::equal_spheres(6, a);
  const Closed closed = close_contacts(p, shapes::frame(x, contacts), table_1);
  EXPECT_EQ(closed.frame.contacts.size(), 12u);
  EXPECT_LT(worst_residual(p, closed.frame), 1e-12 * a);
}

TEST(Closing, HyperstaticClusterIsClosedInLeastSquares) {
  // An octahedron of six around a seventh that is a little too large: 18 contacts against 15 degrees of freedom. By
  // symmetry only the distance rho of the six from the centre is free:
  //   12 (sqrt2 rho - E)^2 + 6 (rho - P)^2 -> min,  rho = (2 sqrt2 E + P)/5.
  // The misfit is small enough (1e-4 a) that no contact is lost.
  const double core = (std::sqrt(2.0) - 1 + 1e-4) * a;
  Particles p = shapes::equal_spheres(7, a);
  p.radius[6] = core;
  const Jkr outer(table_1, a), inner(table_1, pair_radius(a, core));
  const double E = 2 * a + outer.equilibrium_gap, P = a + core + inner.equilibrium_gap;
  const double rho = (2 * std::sqrt(2.0) * E + P) / 5;
  std::vector<Vector3> x{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 0, 0}};
  for (Vector3& v : x) v *= 1.01 * std::sqrt(2.0) * a;
  std::vector<Contact> contacts;
  for (std::int32_t i = 0; i < 7; ++i)
    for (std::int32_t j = i + 1; j < 7; ++j)
      if (i / 2 != j / 2) contacts.push_back({.i = i, .j = j});
  const Closed closed = close_contacts(p, shapes::frame(x, contacts), table_1);
  ASSERT_TRUE(closed.lost.empty());
  ASSERT_TRUE(closed.converged);
  for (int k = 0; k < 6; ++k) {
    const double distance = (closed.frame.position[static_cast<std::size_t>(k)] - closed.frame.position[6]).norm();
    EXPECT_NEAR(distance, rho, 1e-9 * a);  // the minimum is flat: position to the root of the cost's round-off
  }
  const double r_E = std::sqrt(2.0) * rho - E, r_P = rho - P;
  EXPECT_NEAR(closed.residual_max, std::max(std::abs(r_E), std::abs(r_P)), 1e-9 * a);
  EXPECT_NEAR(closed.residual_rms, std::sqrt((12 * r_E * r_E + 6 * r_P * r_P) / 18), 1e-9 * a);
  const double n_E = outer.tension(E + r_E - 2 * a) / outer.pull_off_force;
  const double n_P = inner.tension(P + r_P - a - core) / inner.pull_off_force;
  EXPECT_NEAR(closed.tension_max, std::max(n_E, n_P), 1e-6);
  EXPECT_NEAR(closed.compression_max, -std::min(n_E, n_P), 1e-6);
  EXPECT_GT(closed.compression_max, 0);
}

TEST(Closing, AContactThatCannotCloseIsLostAndReportedAndTheRestIsFree) {
  // Five spheres, a triangle with a cap on either side: nine contacts close exactly; the tenth, between the caps, would
  // need to span 3.27 a.
  const double height = 2 * a * std::sqrt(2.0 / 3), ring = 2 * a / std::sqrt(3.0);
  std::vector<Vector3> x{{0, 0, height}, {0, 0, -height}};
  for (int k = 0; k < 3; ++k) {
    const double phi = 2 * std::numbers::pi * k / 3;
    x.push_back(ring * Vector3(std::cos(phi), std::sin(phi), 0));
  }
  std::vector<Contact> contacts;
  for (std::int32_t i = 0; i < 5; ++i)
    for (std::int32_t j = i + 1; j < 5; ++j) contacts.push_back({.i = i, .j = j});
  const Particles p = shapes::equal_spheres(5, a);
  const Closed closed = close_contacts(p, shapes::frame(x, contacts), table_1);
  ASSERT_EQ(closed.lost.size(), 1u);
  EXPECT_EQ(closed.lost[0].i, 0);
  EXPECT_EQ(closed.lost[0].j, 1);
  EXPECT_NEAR(closed.lost[0].gap, 1.25 * a, 0.05 * a);
  EXPECT_EQ(closed.frame.contacts.size(), 9u);
  EXPECT_LT(worst_residual(p, closed.frame), 1e-12 * a);
}

TEST(Closing, APairThatComesIntoContactUnlistedIsReported) {
  // Two long sides of a triangle are drawn together; the third pair, 1e-4 a apart and not in the list, is pressed.
  const std::vector<Vector3> x{{-1.00005 * a, 0, 0}, {1.00005 * a, 0, 0}, {0, 1.78 * a, 0}};
  const Particles p = shapes::equal_spheres(3, a);
  const Closed closed = close_contacts(p, shapes::frame(x, {{.i = 0, .j = 2}, {.i = 1, .j = 2}}), table_1);
  ASSERT_EQ(closed.unlisted.size(), 1u);
  EXPECT_EQ(closed.unlisted[0].i, 0);
  EXPECT_EQ(closed.unlisted[0].j, 1);
  EXPECT_LT(closed.unlisted[0].gap, 0);
}

TEST(Closing, APairThatComesIntoContactUnlistedIsClosedTooWhereAllAreWanted) {
  const std::vector<Vector3> x{{-1.00005 * a, 0, 0}, {1.00005 * a, 0, 0}, {0, 1.78 * a, 0}};
  const Particles p = shapes::equal_spheres(3, a);
  std::size_t made = 0;
  const Closed closed = close_all_contacts(p, shapes::frame(x, {{.i = 0, .j = 2}, {.i = 1, .j = 2}}), table_1, made);
  EXPECT_EQ(made, 1u);
  EXPECT_TRUE(closed.unlisted.empty());
  ASSERT_EQ(closed.frame.contacts.size(), 3u);
  EXPECT_EQ(closed.frame.contacts[0].j, 1);
  EXPECT_LT(worst_residual(p, closed.frame), 1e-12 * a);
  EXPECT_LT(closed.tension_rms, 1e-9);
}

TEST(Closing, ScalingToTenTimesTheRadiusKeepsTheListAndFreesTheBonds) {
  const Grown small = random_tree(115, a, a, 0, 6);
  const Closed dried = close_contacts(small.particles, small.frame, table_1);
  const Particles large = shapes::equal_spheres(115, 10 * a);
  Frame scaled = dried.frame;
  for (Vector3& v : scaled.position) v *= 10;
  // Geometric scaling alone keeps gap/a = -0.00872, compression far beyond what the bonds bear in tension.
  const Jkr law(table_1, 10 * a);
  EXPECT_LT(law.tension(10 * dried.frame.contacts[0].gap) / law.pull_off_force, -5);
  const Closed closed = close_contacts(large, scaled, table_1);
  EXPECT_EQ(closed.frame.contacts.size(), 114u);
  EXPECT_LT(worst_residual(large, closed.frame), 1e-11 * a);
  EXPECT_LT(closed.tension_rms, 1e-9);
}

TEST(Closing, HistoriesAndLoadsAreGone) {
  Frame f = shapes::frame({{0, 0, 0}, {2.01 * a, 0, 0}}, {{.i = 0, .j = 1}});
  Contact& c = f.contacts[0];
  c.sliding = c.rolling = c.sliding_force = c.rolling_torque = Vector3(1, 2, 3);
  c.twisting = c.twisting_torque = 4;
  c.at_limit = 7;
  c.born = 42;
  f.velocity.assign(2, Vector3(1, 1, 1));
  const Closed closed = close_contacts(shapes::equal_spheres(2, a), f, table_1);
  const Contact& after = closed.frame.contacts[0];
  EXPECT_EQ(after.sliding.norm() + after.rolling.norm() + after.sliding_force.norm() + after.rolling_torque.norm(), 0);
  EXPECT_EQ(after.twisting, 0);
  EXPECT_EQ(after.twisting_torque, 0);
  EXPECT_EQ(after.at_limit, 0);
  EXPECT_EQ(after.born, 42);
  EXPECT_TRUE(closed.frame.velocity.empty());
}

TEST(Closing, TurnsWithTheAgglomerateAndKeepsItsCentre) {
  const Grown g = random_tree(60, a, 3 * a, 0.02, 7);
  const Quaternion turn = Quaternion(0.1, 0.8, -0.4, 0.3).normalized();
  Frame turned = g.frame;
  for (Vector3& v : turned.position) v = turn * v;
  const Closed plain = close_contacts(g.particles, g.frame, table_1);
  const Closed after = close_contacts(g.particles, turned, table_1);
  Vector3 drift = Vector3::Zero();
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_LT((turn * plain.frame.position[i] - after.frame.position[i]).norm(), 1e-9 * a);
    drift += plain.frame.position[i] - g.frame.position[i];
  }
  EXPECT_LT(drift.norm(), 1e-10 * a);
}

TEST(Closing, OneParticleHasNothingToClose) {
  const Closed closed = close_contacts(shapes::equal_spheres(1, a), shapes::frame({{1, 2, 3}}), table_1);
  EXPECT_EQ(closed.frame.position[0], Vector3(1, 2, 3));
  EXPECT_TRUE(closed.converged);
  EXPECT_EQ(closed.tension_max, 0);
}

TEST(Closing, WrongListsAndCoincidentCentresAreRefusedByName) {
  const Particles p = shapes::equal_spheres(3, a);
  const auto message = [&](std::vector<Vector3> x, std::vector<Contact> contacts) -> std::string {
    try {
      close_contacts(p, shapes::frame(std::move(x), std::move(contacts)), table_1);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  const auto x = shapes::chain(3, 2 * a);
  EXPECT_NE(message(x, {{.i = 1, .j = 3}}).find("1-3"), std::string::npos);
  EXPECT_NE(message(x, {{.i = 2, .j = 1}}).find("2-1"), std::string::npos);
  EXPECT_NE(message(x, {{.i = 0, .j = 1}, {.i = 1, .j = 2}, {.i = 0, .j = 1}}).find("0-1 is listed twice"),
            std::string::npos);
  EXPECT_NE(message({{0, 0, 0}, {a, 0, 0}, {a, 0, 0}}, {{.i = 1, .j = 2}}).find("1-2"), std::string::npos);
}

TEST(Closing, TenThousandSpheresOnADisturbedLatticeAreClosed) {
  auto x = shapes::lattice_ellipsoid(Vector3::Constant(270e-9), 2 * a);
  ASSERT_GT(x.size(), 10000u);
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> shift(-0.003 * a, 0.003 * a);
  for (Vector3& v : x) v += Vector3(shift(engine), shift(engine), shift(engine));
  const Particles p = shapes::equal_spheres(x.size(), a);
  std::vector<Contact> contacts;
  for (const NearPair& pair : near_pairs(x, p.radius, 0.02)) contacts.push_back({.i = pair.i, .j = pair.j});
  const Closed closed = close_contacts(p, shapes::frame(x, contacts), table_1);
  EXPECT_EQ(closed.frame.contacts.size(), contacts.size());
  EXPECT_LT(worst_residual(p, closed.frame), 1e-11 * a);
  EXPECT_TRUE(closed.converged);
}

}  // namespace
}  // namespace crumble
