// Particles of different size, from the scene to the granule.
#include "dryer/particle_radii.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/agglomerate/morphology.hpp"
#include "dryer/regime.hpp"
#include "dryer/run.hpp"
#include "tests/seeds.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

using Kind = RadiusDistribution::Kind;
const RadiusDistribution lognormal{Kind::lognormal, 10e-9, 1.4, 0, 0};
const RadiusDistribution bimodal{Kind::bimodal, 10e-9, 1, 20e-9, 0.25};

double sum_of_cubes(const std::vector<double>& radius) {
  return std::accumulate(radius.begin(), radius.end(), 0.0, [](double sum, double a) { return sum + a * a * a; });
}

DryingScene scene_of(const std::string& particle, double lifetime = 5e-5) {
  const std::string text = "[particle]\nradius = 10e-9\n" + particle +
                           fmt::format("\n[droplet]\nradius = 150e-9\nlifetime = {}\n[integrator]\n", lifetime) +
                           "largest_displacement = 0.1\nsoftening = 2\n" + fmt::format("[run]\nseed = {}\n", seeded(1));
  return drying_scene(Scene::parse(text, "drying.toml", drying_parameters()));
}

TEST(ParticleRadii, lognormal_has_its_median_and_its_width) {
  const std::size_t N = 20000;
  double mean = 0, square = 0;
  for (const double a : radii_by_number(lognormal, N, seeded(1))) {
    const double z = std::log(a / 10e-9) / std::log(1.4);
    EXPECT_LE(std::abs(z), 3 + 1e-12);
    mean += z / N;
    square += z * z / N;
  }
  // Of a normal number cut at +-3 the variance is 1 - 6 phi(3)/(2 Phi(3) - 1) = 0.9733. Five standard errors: 6e-7
  // by chance for the mean, less for the variance, which takes that of a whole normal number.
  expect_near("mean", mean, 0, 5 / std::sqrt(N));
  expect_near("variance", square, 0.9733, 5 * std::sqrt(2.0 / N));
}

TEST(ParticleRadii, are_descending_and_follow_from_the_seed) {
  const auto radius = radii_by_number(lognormal, 100, 7);
  EXPECT_TRUE(std::is_sorted(radius.rbegin(), radius.rend()));
  EXPECT_EQ(radius, radii_by_number(lognormal, 100, 7));
  EXPECT_NE(radius, radii_by_number(lognormal, 100, 8));
}

TEST(ParticleRadii, bimodal_has_its_share_by_number) {
  const auto radius = radii_by_number(bimodal, 101, 1);
  EXPECT_EQ(std::count(radius.begin(), radius.end(), 20e-9), 25);
  EXPECT_EQ(std::count(radius.begin(), radius.end(), 10e-9), 76);
}

TEST(ParticleRadii, by_volume_come_as_near_as_one_particle_allows) {
  for (const RadiusDistribution& d : {lognormal, bimodal}) {
    const double target = 300 * 1e-24;
    const auto radius = radii_by_volume(d, target, 3);
    EXPECT_NEAR(sum_of_cubes(radius), target, std::pow(radius.front(), 3)) << static_cast<int>(d.kind);
  }
}

TEST(ParticleRadii, both_ways_to_say_how_much_work_with_distributions) {
  for (const std::string kind : {"distribution = \"lognormal\"\ngeometric_standard_deviation = 1.3\n",
                                 "distribution = \"bimodal\"\nsecond_radius = 4e-9\nsecond_share = 0.5\n"}) {
    EXPECT_EQ(scene_of(kind + "number = 33").radius.size(), 33u);
    const DryingScene s = scene_of(kind + "solids_fraction = 0.05");
    EXPECT_NEAR(drying_regime(s).solids_fraction, 0.05, std::pow(s.largest_radius() / 150e-9, 3));
  }
}

TEST(ParticleRadii, of_a_start_are_those_of_the_scene_and_nothing_overlaps) {
  const DryingScene s =
      scene_of("distribution = \"bimodal\"\nsecond_radius = 1e-9\nsecond_share = 0.9\nnumber = 300");  // ratio 10
  const DryingRun run(s, 1);
  const Agglomerate& state = run.state();
  EXPECT_EQ(state.particles.radius, s.radius);
  for (std::size_t i = 0; i < 300; ++i) {
    EXPECT_LE(state.state.position[i].norm() + s.radius[i], 150e-9);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((state.state.position[i] - state.state.position[j]).norm(), s.radius[i] + s.radius[j]);
  }
}

struct Case {
  const char *name, *particle;
  double lifetime;
  // Bounds; those of 20 particles that differ by ten, of which small ones stay loose, scatter more.
  double share = 0.8, coordination = 2, deepest = 0.05;
};
class Polydisperse : public ::testing::TestWithParam<Case> {};

// Every contact of the dry granule has the law of its own two spheres: bonds at rest have the equilibrium gap of their
// R*, within what the remaining loads stretch.
TEST_P(Polydisperse, droplet_dries_to_one_granule_without_deep_overlaps) {
  const DryingScene s = scene_of(GetParam().particle, GetParam().lifetime);
  DryingRun run(s, 1);
  while (!run.finished()) run.step();
  const Agglomerate& dry = run.state();
  const Morphology m = morphology(dry.particles, dry.state);
  expect_within("share in one piece", static_cast<double>(m.largest_fragment) / static_cast<double>(s.radius.size()),
                GetParam().share, 1);
  expect_within("coordination", m.coordination, GetParam().coordination, unbounded);
  double deepest = 0;
  for (const Contact& c : dry.state.contacts) {
    const double a = pair_radius(s.radius[c.i], s.radius[c.j]);
    const BondLaw law(s.model.contact, s.model.material, s.radius[c.i], s.radius[c.j]);
    deepest = std::max(deepest, -c.gap / a);
    EXPECT_LE(c.gap, law.lost_gap());
  }
  expect_within("deepest overlap", deepest, 0, GetParam().deepest);
}

INSTANTIATE_TEST_SUITE_P(
    Dryer, Polydisperse,
    ::testing::Values(
        Case{"lognormal", "distribution = \"lognormal\"\ngeometric_standard_deviation = 1.4\nnumber = 40", 5e-5},
        Case{"bimodal", "distribution = \"bimodal\"\nsecond_radius = 20e-9\nsecond_share = 0.2\nnumber = 40", 5e-5},
        Case{"lognormal_with_noise",
             "distribution = \"lognormal\"\ngeometric_standard_deviation = 1.3\nnumber = 30\nbrownian_motion = true",
             2e-5},
        Case{"radii_that_differ_by_ten",
             "distribution = \"bimodal\"\nsecond_radius = 1e-9\nsecond_share = 0.3\nnumber = 20", 5e-5, 0.7, 1.45,
             0.06}),
    [](const auto& given) { return std::string(given.param.name); });

}  // namespace
