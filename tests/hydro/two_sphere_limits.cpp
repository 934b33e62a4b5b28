// Limits with closed form: contact, infinity, a rigid doublet.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/hydro/near_field.hpp"
#include "common/hydro/two_sphere_pair.hpp"
#include "common/hydro/two_sphere_series.hpp"

namespace crumble {
namespace {

// Jeffrey & Onishi 1984 print four decimals of the constants and stop before O(xi), whose factor is below 0.13.
TEST(TwoSphereLimits, NearContactAgreesWithLubricationTheory) {
  for (const double xi : {1e-6, 1e-5, 1e-4}) {
    const ResistanceScalars f = two_sphere_resistance(xi);
    const double L = std::log(1 / xi), tolerance = 6e-5 + 0.2 * xi * (1 + L);
    EXPECT_NEAR(f.XA11, 1 / (4 * xi) + 9. / 40 * L + 0.9954 + 3. / 112 * xi * L, tolerance);
    EXPECT_NEAR(f.XA12, -1 / (4 * xi) - 9. / 40 * L - 0.3502 - 3. / 112 * xi * L, tolerance);
    EXPECT_NEAR(f.YA11, L / 6 + 0.9983, tolerance);
    EXPECT_NEAR(f.YA12, -L / 6 - 0.2737, tolerance);
  }
}

// What the singular forms leave of the exact series.
std::array<double, ResistanceScalars::count> remainder(double xi, double lambda) {
  const auto forms = near_field(lambda);
  const auto f = two_sphere_series_pair(xi, lambda).one;
  const double L = std::log(1 / xi);
  std::array<double, ResistanceScalars::count> rest{};
  for (int k = 0; k < ResistanceScalars::count; ++k)
    rest[k] = static_cast<double>(f[k] - forms[k].inverse / xi - forms[k].log * L - forms[k].xi_log * xi * L);
  return rest;
}

// A finite value and slope remain, so halving the gap halves the change. A wrong coefficient of 1/xi or ln(1/xi) fails
// at once, one of xi ln(1/xi) that is off by 1 % (1e-3 or so) adds 1e-3 xi ln 2 = 1.4e-6 at xi = 2e-3.
TEST(TwoSphereLimits, SingularFormsLeaveARemainderThatIsLinearAtContact) {
  for (const double lambda : {1.0, 0.4, 2.5}) {
    const double xi = 2e-3;
    const auto whole = remainder(xi, lambda), half = remainder(xi / 2, lambda), quarter = remainder(xi / 4, lambda);
    for (int k = 0; k < ResistanceScalars::count; ++k)
      EXPECT_NEAR(whole[k] - half[k], 2 * (half[k] - quarter[k]), 3e-6)
          << ResistanceScalars::names[k] << " lambda " << lambda;
  }
}

TEST(TwoSphereLimits, RemoteSpheresAreIsolated) {
  const ResistanceScalars f = two_sphere_resistance(std::numeric_limits<double>::infinity());
  ResistanceScalars isolated;
  isolated.XA11 = isolated.YA11 = 1;
  isolated.XC11 = isolated.YC11 = 4. / 3;
  isolated.XM11 = isolated.YM11 = isolated.ZM11 = 10. / 9;
  const auto found = f.values(), expected = isolated.values();
  for (int k = 0; k < ResistanceScalars::count; ++k)  // 1e-11: sum of the neglected Chebyshev terms
    EXPECT_NEAR(found[k], expected[k], 1e-11) << ResistanceScalars::names[k];
}

// Leading terms of the method of reflections in 1/s; the next terms are smaller by 1/s at least, with factors below 5.
TEST(TwoSphereLimits, FarFieldDecaysAsReflectionsSay) {
  const double s = 400;
  for (const double ratio : {1.0, 0.3, 4.0}) {
    const ResistanceScalars f = two_sphere_resistance(s - 2, ratio);
    const double a = 2 / (1 + ratio), b = ratio * a, a3 = a * a * a, b3 = b * b * b;
    const double table = ratio == 1 ? 3e-12 : 2e-9;
    const auto close = [=](double found, double leading, const char* name) {
      EXPECT_NEAR(found, leading, std::abs(leading) * 5 / s + table * (a3 + 1)) << name << " ratio " << ratio;
    };
    close(f.XA12, -3 * a * b / (2 * s), "XA12");
    close(f.YA12, -3 * a * b / (4 * s), "YA12");
    close(f.XA11 - a, 9 * a * a * b / (4 * s * s), "XA11");
    close(f.YA11 - a, 9 * a * a * b / (16 * s * s), "YA11");
    close(f.YB12, a3 * b / (s * s), "YB12");
    close(f.XC12, -4. / 3 * a3 * b3 / (s * s * s), "XC12");
    close(f.YC12, 2. / 3 * a3 * b3 / (s * s * s), "YC12");
    close(f.XG12, -5. / 2 * a3 * b / (s * s), "XG12");
    close(f.YH12, 5. / 3 * a3 * b3 / (s * s * s), "YH12");
    close(f.XM12, 50. / 9 * a3 * b3 / (s * s * s), "XM12");
    close(f.YM12, -25. / 9 * a3 * b3 / (s * s * s), "YM12");
  }
}

// Two touching spheres moved as one body: the singular terms cancel, the drag is finite. Reference: converged
// multipoles, error bars 1e-5 (drag in 6 pi mu a).
TEST(TwoSphereLimits, DragOfATouchingDoubletIsFiniteAndRight) {
  for (const double xi : {1e-8, 1e-6, 1e-5}) {
    const ResistanceScalars f = two_sphere_resistance(xi);
    EXPECT_NEAR(2 * (f.XA11 + f.XA12), 1.290283, 1e-5) << xi;
    EXPECT_NEAR(2 * (f.YA11 + f.YA12), 1.449322, 1e-5) << xi;
  }
}

// Tension between two spheres that elongation dU_x/dx = -dU_z/dz = rate/2 pulls apart along x, in 6 pi mu rate a^2.
double doublet_tension(double distance, double evaluated_at) {
  const PairMatrix R = two_sphere_pair(Eigen::Vector3d(evaluated_at, 0, 0), 1, 1, 0);
  const Eigen::Vector3d gradient(0.5, 0, -0.5);
  Eigen::Matrix<double, 22, 1> motion = Eigen::Matrix<double, 22, 1>::Zero();
  for (int i = 0; i < 2; ++i) {
    motion(11 * i) = -gradient.x() * (i == 0 ? -0.5 : 0.5) * distance;
    motion.segment<5>(11 * i + 6) = -strain_components(gradient.asDiagonal());
  }
  const Eigen::Matrix<double, 22, 1> on_fluid = R * motion;
  return -on_fluid(11) / (6 * std::numbers::pi);  // the fluid pulls sphere 2 outwards
}

// 1.01936: converged multipoles, error bar 1e-4 or better.
TEST(TwoSphereLimits, TensionOfATouchingDoubletIsFiniteAndRight) {
  for (const double xi : {1e-8, 1e-6, 1e-5}) EXPECT_NEAR(doublet_tension(2 + xi, 2 + xi), 1.01936, 1e-5) << xi;
}

// Centres at contact with scalars at a floor lose the product of 1/xi with xi, (1/2 xi) (xi/4): 12.3 % at any floor.
TEST(TwoSphereLimits, ScalarsAtAFloorNeedTheDistanceOfThatFloor) {
  for (const double floor : {1e-6, 1e-5}) {
    EXPECT_NEAR(doublet_tension(2, 2 + floor), 1.01936 - 1. / 8, 3e-5);
    EXPECT_NEAR(doublet_tension(effective_distance(2, 1, floor), 2 + floor), 1.01936, 1e-5);
  }
}

TEST(TwoSphereLimits, FloorIsContinuousThroughContact) {
  const double floor = 1e-4;
  EXPECT_EQ(effective_gap(-0.1, floor), floor);
  EXPECT_EQ(effective_gap(0, floor), floor);
  EXPECT_EQ(effective_gap(floor, floor), floor);
  EXPECT_EQ(effective_gap(0.01, floor), 0.01);
  EXPECT_TRUE(std::isnan(effective_gap(std::nan(""), floor)));
  EXPECT_DOUBLE_EQ(effective_distance(3.9, 2, floor), 4 + 2 * floor);
  const PairMatrix overlapping = two_sphere_pair(Eigen::Vector3d(1.9, 0, 0), 1, 1, floor);
  EXPECT_EQ(overlapping, two_sphere_pair(Eigen::Vector3d(2 - 1e-12, 0, 0), 1, 1, floor));
  EXPECT_EQ(overlapping, two_sphere_pair(Eigen::Vector3d(2 + 1e-12, 0, 0), 1, 1, floor));
}

}  // namespace
}  // namespace crumble
