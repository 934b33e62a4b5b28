// First exits along many histories, beside the orbits they are a shortcut of.
#include "rigidstress/first_exit.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <limits>

#include "common/contact/jkr.hpp"
#include "common/numerics/noise.hpp"
#include "samples.hpp"

namespace crumble::rigidstress {
namespace {

LoadedBody loaded(const testing::Cluster& cluster) {
  const Network net = testing::network(cluster);
  return {testing::response(net, {Rung::multipole, 2}),
          std::vector<double>(net.joints().size(), pull_off_force(Material{}, testing::radius))};
}

// Some hundred instants of a gradient that wanders, another one for each track.
GradientHistory wandering(std::size_t track) {
  std::vector<double> time;
  std::vector<Eigen::Matrix3d> gradient;
  Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 120; ++k) {
    for (int c = 0; c < 9; c += 3) {
      const auto n = random_normals(7, Purpose::orientation, static_cast<std::uint32_t>(1000 * track + 9 * k + c), 0);
      for (int i = 0; i < 3; ++i) g(c / 3, i) = 0.9 * g(c / 3, i) + 3 * n[static_cast<std::size_t>(i)];
    }
    g.diagonal().array() -= g.trace() / 3;
    time.push_back(2 + 0.01 * k);
    gradient.push_back(g);
  }
  return GradientHistory::of(std::move(time), std::move(gradient), "made", 10,
                             [](std::size_t k) { return std::to_string(k); });
}

double worst_use(const LoadedBody& body) {
  const WorstContact worst = worst_contact(body.response.tension, body.pull_off, unit_gradient(FlowKind::elongation));
  return worst.tension / body.pull_off[static_cast<std::size_t>(worst.contact)];
}

// Of the contacts of a chain now one, now another bears most.
TEST(FirstExit, IsTheFirstInstantAtWhichTheOrbitOfThisStartBearsMoreThanTheThreshold) {
  const LoadedBody body = loaded(testing::chain(6));
  const Tracks tracks{20, wandering};
  const double worst = worst_use(body);
  const FirstExits found = first_exits(body, tracks, worst, 3, 1e-8);
  double squares = 0;
  for (std::size_t track = 0; track < tracks.size; ++track) squares += wandering(track).mean_square_rate();
  EXPECT_NEAR(found.rms_rate, std::sqrt(squares / 20), 1e-9 * found.rms_rate);  // of equal durations
  int exits = 0, held = 0;
  for (std::size_t track = 0; track < tracks.size; ++track) {
    const GradientHistory h = wandering(track);
    const Orbit orbit = follow(
        body, even_orientations(3, 20)[track], h.times(), [&](double t) { return h(t); }, 1e-8);
    EXPECT_NEAR(found.duration[track], 1.19, 1e-12);
    for (std::size_t k = 0; k < found.level.size(); ++k) {
      // Equal spheres: use is tension over the one pull-off force.
      const double threshold = found.rms_rate * worst / found.level[k] * body.pull_off[0];
      double first = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < orbit.time.size() && std::isinf(first); ++i)
        if (orbit.max_tension[i] >= threshold) first = orbit.time[i] - orbit.time[0];
      EXPECT_EQ(found.at(track, k), first) << "track " << track << ", level " << found.level[k];
      (std::isinf(first) ? held : exits) += 1;
    }
  }
  EXPECT_GT(exits, 100);
  EXPECT_GT(held, 100);
}

TEST(FirstExit, AnyNumberOfThreadsGivesTheSameBits) {
  const LoadedBody body = loaded(testing::chain(4));
  const Tracks tracks{70, wandering};  // more than are held at once
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const FirstExits one = first_exits(body, tracks, worst_use(body), 1, 1e-6);
  omp_set_num_threads(3);
  const FirstExits three = first_exits(body, tracks, worst_use(body), 1, 1e-6);
  omp_set_num_threads(before);
  EXPECT_EQ(one.exit, three.exit);
  EXPECT_EQ(one.rms_rate, three.rms_rate);
}

TEST(FirstExit, CountsExitsAndTimeAtRiskAndThoseBornAboveApart) {
  const double never = std::numeric_limits<double>::infinity();
  FirstExits found;
  found.level = {0.1, 1};
  found.rms_rate = 0.25;  // first edge at 1 s
  found.duration = {8, 8, 3};
  found.exit = {never, 2.5, never, 0, never, 1};
  const ExitCounts counts = count_exits(found);
  EXPECT_EQ(counts.time, (std::vector<double>{0, 1, 2, 4, 8}));
  EXPECT_EQ(counts.born, (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(counts.exits, (std::vector<std::int64_t>{0, 0, 0, 0, 1, 0, 1, 0}));
  EXPECT_EQ(counts.exposure, (std::vector<double>{3, 3, 5, 8, 2, 1, 0.5, 0}));
}

}  // namespace
}  // namespace crumble::rigidstress
