// Flows on known responses: settled orientations, tumbling orbits, histories.
#include "rigidstress/flows.hpp"

#include <gtest/gtest.h>

#include "common/contact/jkr.hpp"
#include "rigidstress/history.hpp"
#include "rigidstress/mobility_numbers.hpp"
#include "samples.hpp"

namespace crumble::rigidstress {
namespace {

using std::numbers::pi;

LoadedBody loaded(const testing::Cluster& cluster, int order) {
  const Network net = testing::network(cluster);
  return {testing::response(net, {Rung::multipole, order}),
          std::vector<double>(net.joints().size(), pull_off_force(Material{}, testing::radius))};
}

const double unit = 6 * pi * testing::radius * testing::radius;

TEST(Flows, DoubletSettlesAlongTheStretchingAxisAndBearsTheWorstThere) {
  const LoadedBody doublet = loaded(testing::chain(2), 6);
  const StrainingResult r = straining(doublet, unit_gradient(FlowKind::elongation), {});
  ASSERT_EQ(r.attractors.size(), 1u);
  EXPECT_NEAR(r.attractors[0].share, 1, 1e-12);
  EXPECT_EQ(r.unsettled, 0);
  EXPECT_NEAR(std::abs((r.attractors[0].orientation * Vector3::UnitX()).x()), 1, 1e-9);
  EXPECT_NEAR(r.attractors[0].peak.tension, r.worst.tension, 1e-9 * r.worst.tension);
}

// A rod in uniaxial flow lies along the axis, where it is stretched; in biaxial flow across the axis, at any azimuth.
TEST(Flows, DoubletInUniaxialAndBiaxialFlow) {
  const LoadedBody doublet = loaded(testing::chain(2), 2);
  const StrainingResult uni = straining(doublet, unit_gradient(FlowKind::uniaxial), {}),
                        bi = straining(doublet, unit_gradient(FlowKind::biaxial), {});
  EXPECT_NEAR(uni.attractors.at(0).peak.tension, uni.worst.tension, 1e-9 * uni.worst.tension);
  EXPECT_NEAR(bi.attractors.at(0).peak.tension, bi.worst.tension, 1e-9 * bi.worst.tension);
  // Strain along the rod per unit shear rate: 1/sqrt 3 and half of it, against 1/2 in planar elongation.
  const double planar = straining(doublet, unit_gradient(FlowKind::elongation), {}).worst.tension;
  EXPECT_NEAR(uni.worst.tension, planar * 2 / std::sqrt(3.0), 1e-9 * planar);
  EXPECT_NEAR(bi.worst.tension, planar / std::sqrt(3.0), 1e-9 * planar);
}

TEST(Flows, UnitShearRateMeansTheSameInEveryFlow) {
  for (const Eigen::Matrix3d& g : {unit_gradient(FlowKind::elongation), unit_gradient(FlowKind::shear),
                                   unit_gradient(FlowKind::uniaxial), unit_gradient(FlowKind::biaxial)}) {
    const Eigen::Matrix3d E = 0.5 * (g + g.transpose());
    EXPECT_NEAR(2 * E.squaredNorm(), 1, 1e-15);
    EXPECT_NEAR(g.trace(), 0, 1e-15);
  }
}

TEST(Flows, OctahedronDoesNotTurnInStrain) {
  const StrainingResult r = straining(loaded(testing::octahedron(), 1), unit_gradient(FlowKind::elongation), {});
  EXPECT_FALSE(r.is_turning);
  EXPECT_EQ(r.unsettled, 0);
}

// Jeffery: a body of revolution of equivalent axis ratio r turns in 2 pi (r + 1/r)/gamma_dot on every orbit. r
// = 1.98165 for touching spheres (converged multipoles); order 8 leaves 1e-5 of the drag.
TEST(Flows, DoubletTumblesInJefferysTime) {
  const LoadedBody doublet = loaded(testing::chain(2), 8);
  ShearChoice choice;
  choice.starts = even_orientations(1, 4);
  const ShearResult r = shear(doublet, choice);
  const double ratio = 1.98165;
  EXPECT_NEAR(r.mean_tumbling_time, 2 * pi * (ratio + 1 / ratio), 2e-3);
  EXPECT_LE(r.orbits[r.worst_orbit].peak.tension, r.supremum.tension);
  for (const Orbit& orbit : r.orbits) EXPECT_GT(orbit.peak.tension, 0);
}

TEST(Flows, SphereTumblesInFourPi) {
  EXPECT_NEAR(shear(loaded(testing::octahedron(), 1), {}).mean_tumbling_time, 4 * pi, 1e-3);
}

// Means over all orientations of x^2 and of |x y|, x and y components of a turned unit vector, are 1/3 and 2/(3 pi). Of
// 128 independent ones they would be known to 0.026 and 0.014. Root mean squares over 60 seeds.
TEST(Orientations, AreFilledMoreEvenlyThanAtRandom) {
  double square = 0, product = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    double one = 0, other = 0;
    for (const Quaternion& q : even_orientations(seed, 128)) {
      const Vector3 x = q * Vector3(0.6, 0, 0.8);
      one += x.x() * x.x() / 128;
      other += std::abs(x.x() * x.y()) / 128;
    }
    square += std::pow(one - 1.0 / 3, 2) / 60;
    product += std::pow(other - 2 / (3 * pi), 2) / 60;
  }
  std::printf("rms errors %.4f, %.4f\n", std::sqrt(square), std::sqrt(product));
  EXPECT_LT(std::sqrt(square), 0.010);
  EXPECT_LT(std::sqrt(product), 0.0135);
}

// How a cluster lies in its file must not matter: the mean over the default orbits is known to 2 %, and to about the
// stated error.
TEST(Flows, MeanOverOrbitsDoesNotDependOnHowTheBodyLies) {
  testing::Cluster cluster = testing::touching({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 2, 0}, {4, 2, 2}});
  std::vector<double> means;
  double stated = 0;
  for (int k = 0; k < 12; ++k) {
    const Quaternion turn = even_orientations(77, 12)[k];
    testing::Cluster turned = cluster;
    for (Vector3& x : turned.position) x = turn * x;
    const ShearResult r = shear(loaded(turned, 1), {});
    means.push_back(r.mean_peak_tension / unit);
    stated = std::max(stated, r.mean_error.value());
  }
  const auto [least, most] = std::minmax_element(means.begin(), means.end());
  std::printf("means from %.4f to %.4f, largest stated error %.2f %%\n", *least, *most, 100 * stated);
  EXPECT_LT(*most / *least - 1, 0.06) << "2 % to either side, three times the standard error";
  EXPECT_LT(stated, 0.04);
  EXPECT_GT(stated, 0.001);
}

TEST(Flows, AMeanOfFewOrbitsHasNoStatedError) {
  EXPECT_FALSE(error_of_mean(std::vector<double>(15, 1.0)));
  EXPECT_EQ(error_of_mean(std::vector<double>(16, 1.0)).value(), 0);
}

// A doublet that lies in the flow plane passes 45 degrees, where it is stretched along its axis: its orbit reaches the
// supremum, 1.01936 for converged multipoles, but for the interval of the samples.
TEST(Flows, DoubletInTheFlowPlaneReachesTheSupremum) {
  const LoadedBody doublet = loaded(testing::chain(2), 8);
  std::vector<double> times;
  for (int k = 0; k <= 2000; ++k) times.push_back(0.01 * k);
  const Orbit orbit =
      follow(doublet, Quaternion::Identity(), times, [](double) { return unit_gradient(FlowKind::shear); });
  EXPECT_NEAR(orbit.peak.tension / unit, 1.01936, 2e-4);
}

TEST(Flows, OrientationErrorFollowsItsTolerance) {
  const LoadedBody body = loaded(testing::raft(3), 1);
  std::vector<double> times{0, 50};
  const auto end = [&](double tolerance) {
    return follow(
               body, even_orientations(1, 4)[0], times, [](double) { return unit_gradient(FlowKind::shear); },
               tolerance)
        .orientation.back();
  };
  const Quaternion exact = end(1e-13);
  double before = 1;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const double error = exact.angularDistance(end(tolerance));
    // Some hundred steps, each within the tolerance, whose errors shear carries along at a linear rate.
    EXPECT_LT(error, 1e4 * tolerance);
    EXPECT_LT(error, before);
    before = error;
  }
}

std::string history_text(const std::string& rows, const std::string& time = "t [s]",
                         const std::string& rate = "[1/s]") {
  std::string text = "# a comment\n" + time;
  for (const char* name : {"ux_x", "ux_y", "ux_z", "uy_x", "uy_y", "uy_z", "uz_x", "uz_y", "uz_z"})
    text += std::string(",") + name + " " + rate;
  return text + "\n" + rows;
}

std::string refusal(const std::string& text) {
  try {
    GradientHistory::parse(text, "flow.csv");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(History, SteadyShearFromAFileIsSteadyShear) {
  std::string rows;
  for (int k = 0; k <= 200; ++k) rows += std::to_string(0.001 * k) + ",0,100,0,0,0,0,0,0,0\n";
  const GradientHistory history = GradientHistory::parse(history_text(rows), "flow.csv");
  EXPECT_NEAR(history.largest_rate(), 100, 1e-12);
  const LoadedBody doublet = loaded(testing::chain(2), 2);
  const HistoryResult found = follow_history(doublet, history, even_orientations(1, 4));
  std::vector<double> times;
  for (int k = 0; k <= 200; ++k) times.push_back(0.1 * k);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Orbit same =
        follow(doublet, even_orientations(1, 4)[k], times, [](double) { return unit_gradient(FlowKind::shear); });
    EXPECT_NEAR(found.orbits[k].peak.tension, 100 * same.peak.tension, 1e-5 * 100 * same.peak.tension);
  }
}

TEST(History, InterpolatesBetweenRows) {
  const GradientHistory h =
      GradientHistory::parse(history_text("0,0,2,0,0,0,0,0,0,0\n0.1,0,4,0,0,0,0,0,0,0\n"), "flow.csv");
  EXPECT_NEAR(h(0.025)(0, 1), 2.5, 1e-14);
  EXPECT_NEAR(h(-1)(0, 1), 2, 0);
  EXPECT_NEAR(h(1)(0, 1), 4, 0);
}

// The same flow, whatever the order of its columns.
TEST(History, ColumnsAreFoundByTheirNames) {
  const std::string header =
      "du_y/dx [1/s],duz/dx [1/s],t [s],duX/dy [1/s],ux_x [1/s],vy [1/s],dwdy [1/s],"
      "uz_z [s-1],dux/dz [1/s],\"duy / dz [s^-1]\"\n";
  const GradientHistory h =
      GradientHistory::parse(header + "21,31,0,12,1,2,32,-3,13,23\n21,31,0.001,12,1,2,32,-3,13,23\n", "f");
  Eigen::Matrix3d expected;
  expected << 1, 12, 13, 21, 2, 23, 31, 32, -3;
  EXPECT_EQ(h(0), expected);
  const std::string rows = "0,0,1,0,0,0,0,0,0,0\n0.1,0,1,0,0,0,0,0,0,0\n";
  std::string twice = history_text(rows);
  twice.replace(twice.find("ux_y"), 4, "ux_x");
  EXPECT_NE(refusal(twice).find("columns 2 'ux_x [1/s]' and 3 'ux_x [1/s]' are the same component"), std::string::npos)
      << refusal(twice);
  std::string unknown = history_text(rows);
  unknown.replace(unknown.find("uz_y"), 4, "xy");  // of which index is which, nobody agrees
  EXPECT_NE(refusal(unknown).find("column 9 'xy [1/s]' is neither the time"), std::string::npos) << refusal(unknown);
}

TEST(History, RefusesWhatCannotBeAVelocityGradientInTime) {
  const std::string good = "0,0,1,0,0,0,0,0,0,0\n0.1,0,1,0,0,0,0,0,0,0\n";
  EXPECT_EQ(refusal(history_text(good)), "");
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(refusal(text).find(part), std::string::npos) << refusal(text);
  };
  expect(history_text(good, "t [ms]"), "flow.csv:2: column 1 't [ms]' must carry its unit, [s]");
  expect(history_text(good, "t [s]", "[1/ms]"), "must carry its unit, [1/s]");
  expect(good, "flow.csv:1: column 1");  // no header
  expect(history_text("0,1,1,0,0,0,0,0,0,0\n"), "trace");
  expect(history_text("0,0,1,0,0,0,0,0,0\n"), "flow.csv:3: expected 10 values as in the header, found 9");
  expect(history_text("0,0,nan,0,0,0,0,0,0,0\n"), "expected a finite number, found 'nan'");
  expect(history_text("0,0,1,0,0,0,0,0,0,0\n0,0,1,0,0,0,0,0,0,0\n"), "times must increase");
  expect(history_text("0,0,1,0,0,0,0,0,0,0\n5,0,1,0,0,0,0,0,0,0\n"), "the flow strains by 5");
  std::string gap;
  for (const double t : {0.0, 0.01, 0.02, 0.03, 0.5}) gap += std::to_string(t) + ",0,1,0,0,0,0,0,0,0\n";
  expect(history_text(gap), "a gap in time");
  expect(history_text("0,0,1,0,0,0,0,0,0,0\n"), "at least two instants");
}

// Free rotation of two touching spheres about their axis: 8 pi (3/2) zeta(3); drag from converged multipoles.
TEST(MobilityNumbers, OfTheDoublet) {
  const Network net = testing::network(testing::chain(2));
  const MobilityNumbers n = mobility_numbers(testing::response(net, {Rung::multipole, 8}).drag);
  const double a = testing::radius;
  EXPECT_NEAR(n.drag[0] / (6 * pi * a), 1.290283, 1e-5);
  EXPECT_NEAR(n.drag[2] / (6 * pi * a), 1.449322, 1e-5);
  EXPECT_NEAR(n.rotation[0] / (8 * pi * a * a * a), 1.5 * 1.2020569, 1e-4);
  EXPECT_NEAR(n.hydrodynamic_radius / a, 3 / (1 / 1.290283 + 2 / 1.449322), 1e-5);
}

// The hydrodynamic radius does not depend on the point that drag is taken about.
TEST(MobilityNumbers, HydrodynamicRadiusIsThatOfTheCentreOfMobility) {
  testing::Cluster bent = testing::touching({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 2, 0}, {4, 2, 2}});
  const Network net = testing::network(bent);
  const auto radius_about = [&](const Vector3& point) {
    const DenseHydrodynamics hydrodynamics({net.position(), net.radius()}, 1, {});
    return mobility_numbers(rigid_body_response(hydrodynamics, net.position(), point).drag).hydrodynamic_radius;
  };
  const double reference = radius_about(testing::centre(net.position()));
  EXPECT_NEAR(radius_about({3e-7, -5e-7, 2e-7}), reference, 1e-9 * reference);
}

}  // namespace
}  // namespace crumble::rigidstress
