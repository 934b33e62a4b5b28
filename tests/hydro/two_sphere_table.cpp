// The stored table against the exact series.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <vector>

#include "common/hydro/near_field.hpp"
#include "common/hydro/two_sphere.hpp"
#include "common/hydro/two_sphere_series.hpp"
#include "common/hydro/two_sphere_table.hpp"

namespace crumble {
namespace {

struct Reference {
  double gap, radius_ratio;
  ResistanceScalars f;
};

std::vector<Reference> stored_reference() {
  std::ifstream in(CRUMBLE_SOURCE_DIR "/data/two_sphere_reference.txt");
  std::vector<Reference> result;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    Reference r;
    std::array<double, ResistanceScalars::count> values{};
    words >> r.gap >> r.radius_ratio;
    for (double& v : values) words >> v;
    r.f = ResistanceScalars::from(values);
    EXPECT_FALSE(words.fail()) << line;
    result.push_back(r);
  }
  return result;
}

// What an error is measured against: the scalar itself, or where that is small the isolated value it belongs to, the
// geometric mean of the two spheres' (that is what positive definiteness bounds a coupling by).
double scale(int k, double value, double radius_ratio) {
  const two_sphere::SelfScale self(2 / (1 + radius_ratio), 2 * radius_ratio / (1 + radius_ratio));
  const char kind = ResistanceScalars::names[k][1];
  return std::max(std::abs(value), (kind == 'C' ? 4. / 3 : kind == 'M' ? 10. / 9 : 1) * self.of(k));
}

double worst_error(const ResistanceScalars& found, const ResistanceScalars& exact, double radius_ratio) {
  const auto f = found.values(), x = exact.values();
  double worst = 0;
  for (int k = 0; k < ResistanceScalars::count; ++k)
    worst = std::max(worst, std::abs(f[k] - x[k]) / scale(k, x[k], radius_ratio));
  return worst;
}

// The bound promised to users is 1e-6; these are what the truncation of the two tables leaves (TWO_SPHERES.md).
double truncation(double radius_ratio) { return radius_ratio == 1 ? 5e-10 : 3e-8; }

TEST(TwoSphereTable, FollowsTheStoredExactSolutionFromContactToInfinity) {
  const auto reference = stored_reference();
  ASSERT_GE(reference.size(), 100u);
  for (const Reference& r : reference)
    EXPECT_LT(worst_error(two_sphere_resistance(r.gap, r.radius_ratio), r.f, r.radius_ratio),
              truncation(r.radius_ratio))
        << "gap " << r.gap << " ratio " << r.radius_ratio;
}

TEST(TwoSphereTable, FollowsTheLiveSeriesAtRandomGaps) {
  std::mt19937 random(20260101);
  std::uniform_real_distribution<double> exponent(-3, 3);
  for (int i = 0; i < 30; ++i) {
    const double gap = std::pow(10, exponent(random));
    double asymmetry = 1;
    const ResistanceScalars exact = two_sphere_series(gap, 1, &asymmetry);
    EXPECT_LT(asymmetry, 1e-15) << gap;  // the series' own error: the terms left out
    EXPECT_LT(worst_error(two_sphere_resistance(gap), exact, 1), truncation(1)) << gap;
  }
}

TEST(TwoSphereTable, FollowsTheLiveSeriesAtRandomRadiusRatios) {
  std::mt19937 random(20260102);
  std::uniform_real_distribution<double> exponent(-2.5, 3), lg_ratio(-1, 1);
  for (int i = 0; i < 30; ++i) {
    const double gap = std::pow(10, exponent(random)), ratio = std::pow(10, lg_ratio(random));
    double asymmetry = 1;
    const ResistanceScalars exact = two_sphere_series(gap, ratio, &asymmetry);
    EXPECT_LT(asymmetry, 1e-15) << gap << " ratio " << ratio;
    EXPECT_LT(worst_error(two_sphere_resistance(gap, ratio), exact, ratio), truncation(ratio))
        << gap << " ratio " << ratio;
  }
}

TEST(TwoSphereTable, TendsToEqualSpheresFromBothSides) {
  for (const double gap : {1e-5, 1e-3, 0.05, 0.7, 3.0, 1e3})
    for (const double ratio : {1 - 1e-9, 1 + 1e-9})
      EXPECT_LT(worst_error(two_sphere_resistance(gap, ratio), two_sphere_resistance(gap), 1), truncation(ratio))
          << gap;
}

TEST(TwoSphereTable, IsContinuousAtTheBordersOfItsSegments) {
  for (const double ratio : {1.0, 0.1, 0.37, 8.0})
    for (const auto& segment : two_sphere::segments) {
      if (segment.begin == 0) continue;
      const double below = std::nextafter(segment.begin, 0.), above = std::nextafter(segment.begin, 1e9);
      EXPECT_LT(worst_error(two_sphere_resistance(below, ratio), two_sphere_resistance(above, ratio), ratio),
                2 * truncation(ratio))
          << segment.begin << " ratio " << ratio;
    }
}

// Values of an independent twin-multipole computation, to its printed digits (error bars 1e-9 and 1e-8).
TEST(TwoSphereTable, AgreesWithAnIndependentMultipoleComputation) {
  const ResistanceScalars wide = two_sphere_resistance(1);
  EXPECT_NEAR(wide.XA11, 1.368479602, 1e-9);
  EXPECT_NEAR(wide.XA12, -0.670175042, 1e-9);
  EXPECT_NEAR(wide.YA11, 1.092101753, 1e-9);
  EXPECT_NEAR(wide.YA12, -0.297175858, 1e-9);
  EXPECT_NEAR(wide.YB11, -0.037830989, 1e-9);
  EXPECT_NEAR(wide.YC11, 1.357314287, 1e-9);
  EXPECT_NEAR(wide.YC12, 0.028886220, 1e-9);
  EXPECT_NEAR(wide.XG11, 0.217292192, 1e-9);
  EXPECT_NEAR(wide.XM11, 1.205943772, 1e-9);
  EXPECT_NEAR(wide.YM11, 1.127266451, 1e-9);
  EXPECT_NEAR(wide.ZM11, 1.111688931, 1e-9);
  const ResistanceScalars close = two_sphere_resistance(0.01);
  EXPECT_NEAR(close.XA11, 27.03400787, 1e-8);
  EXPECT_NEAR(close.XA12, -26.38828579, 1e-8);
  EXPECT_NEAR(close.YA11, 1.766960166, 1e-8);
  EXPECT_NEAR(close.YA12, -1.041438424, 1e-8);
  EXPECT_NEAR(close.YB11, -0.613985102, 1e-8);
  EXPECT_NEAR(close.YC11, 2.180086292, 1e-8);
  EXPECT_NEAR(close.YC12, 0.274068105, 1e-8);
  EXPECT_NEAR(close.XG11, 25.7320963, 5e-8);
  EXPECT_NEAR(close.XM11, 18.16248681, 1e-8);
  EXPECT_NEAR(close.YM11, 1.599701223, 1e-8);
  EXPECT_NEAR(close.ZM11, 1.135767285, 1e-8);
}

TEST(TwoSphereTable, RefusesWhatItDoesNotHold) {
  EXPECT_THROW(two_sphere_resistance(0), std::invalid_argument);
  EXPECT_THROW(two_sphere_resistance(-0.1), std::invalid_argument);
  EXPECT_THROW(two_sphere_resistance(std::nan("")), std::invalid_argument);
  EXPECT_THROW(two_sphere_resistance(0.1, 0.09), std::invalid_argument);
  EXPECT_THROW(two_sphere_resistance(0.1, 11), std::invalid_argument);
  EXPECT_THROW(two_sphere_resistance(0.1, std::nan("")), std::invalid_argument);
  EXPECT_THROW(two_sphere_series(0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace crumble
