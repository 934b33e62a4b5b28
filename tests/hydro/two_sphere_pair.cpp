// The pair matrix: symmetry, definiteness, invariance, and its inverse.
#include "common/hydro/two_sphere_pair.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "common/hydro/far_field.hpp"

namespace crumble {
namespace {

using Vector22 = Eigen::Matrix<double, 22, 1>;
using Eigen::Matrix3d;
using Eigen::Vector3d;

const std::vector<double> gaps = {1e-8, 1e-6, 1e-4, 2e-3, 0.03, 0.15, 0.5, 3, 50, 1e4};

struct Radii {
  double one, two;
};
// Mean radius 1, so that gaps are what they say.
const std::vector<Radii> radii = {{1, 1}, {1.4, 0.6}, {2. / 11, 20. / 11}, {20. / 11, 2. / 11}};

Vector3d random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

// How a pair matrix turns: vectors with Q, pseudovectors with det(Q) Q, strains as tensors.
PairMatrix turning(const Matrix3d& Q) {
  PairMatrix T = PairMatrix::Zero();
  for (int i = 0; i < 2; ++i) {
    T.block<3, 3>(11 * i, 11 * i) = Q;
    T.block<3, 3>(11 * i + 3, 11 * i + 3) = Q.determinant() * Q;
    for (int k = 0; k < 5; ++k)
      T.block<5, 1>(11 * i + 6, 11 * i + 6 + k) =
          strain_components(Q * strain_tensor(Vector5::Unit(k)) * Q.transpose());
  }
  return T;
}

TEST(TwoSpherePair, IsSymmetricAndPositiveDefiniteAtEveryGap) {
  std::mt19937 random(1);
  for (const Radii& a : radii)
    for (const double gap : gaps) {
      const PairMatrix R = two_sphere_pair((2 + gap) * random_direction(random), a.one, a.two, 0);
      EXPECT_LT((R - R.transpose()).norm(), 1e-14 * R.norm()) << gap << " " << a.one;
      // In units of each sphere's own size the smallest eigenvalue stays of order 6 pi; the largest grows as 1/gap.
      Vector22 size;
      for (int i = 0; i < 2; ++i) {
        size.segment<3>(11 * i).setConstant(std::pow(i == 0 ? a.one : a.two, -0.5));
        size.segment<8>(11 * i + 3).setConstant(std::pow(i == 0 ? a.one : a.two, -1.5));
      }
      const PairMatrix scaled = size.asDiagonal() * R * size.asDiagonal();
      EXPECT_GT(scaled.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 3) << gap << " " << a.one;
    }
}

TEST(TwoSpherePair, TurnsAndReflectsWithTheAxis) {
  std::mt19937 random(2);
  for (const double gap : gaps) {
    const Vector3d e = random_direction(random);
    for (const double sign : {1., -1.}) {
      const Matrix3d Q = sign * Eigen::AngleAxisd(1.1, random_direction(random)).toRotationMatrix();
      const PairMatrix T = turning(Q), R = two_sphere_pair((2 + gap) * e, 1, 1, 0);
      const PairMatrix turned = two_sphere_pair((2 + gap) * (Q * e), 1, 1, 0);
      // Round-off of the gap in the turned distance, relative 1e-15/gap.
      EXPECT_LT((turned - T * R * T.transpose()).norm(), (1e-14 + 4e-15 / gap) * R.norm()) << gap;
    }
  }
}

TEST(TwoSpherePair, ExchangingTheSpheresExchangesTheBlocks) {
  std::mt19937 random(3);
  for (const Radii& a : radii)
    for (const double gap : gaps) {
      const Vector3d r = (2 + gap) * random_direction(random);
      const PairMatrix R = two_sphere_pair(r, a.one, a.two, 0), S = two_sphere_pair(-r, a.two, a.one, 0);
      PairMatrix exchanged;
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          exchanged.block<11, 11>(11 * i, 11 * j) = R.block<11, 11>(11 * (1 - i), 11 * (1 - j));
      EXPECT_LT((S - exchanged).norm(), 1e-14 * R.norm()) << gap << " " << a.one;
    }
}

TEST(TwoSpherePair, ScalesWithLength) {
  const Vector3d r(1.3, -0.7, 1.9);
  const double L = 1e-7;
  const PairMatrix R = two_sphere_pair(r, 1, 1, 0), scaled = two_sphere_pair(L * r, L, L, 0);
  Vector22 unit;
  for (int i = 0; i < 2; ++i) unit.segment<11>(11 * i) << 1, 1, 1, L, L, L, L, L, L, L, L;
  const PairMatrix expected = L * (unit.asDiagonal() * R * unit.asDiagonal()).eval();
  EXPECT_LT(((scaled - expected).array() / expected.array().abs().max(1e-12 * L * L * L)).abs().maxCoeff(), 1e-6);
}

// A far pair is two isolated spheres: 6 pi a, 8 pi a^3, 20/3 pi a^3.
TEST(TwoSpherePair, IsTheIsolatedSphereFarAway) {
  const PairMatrix R = two_sphere_pair(Vector3d(3e9, 4e9, 0), 1.5, 1.5);
  Vector22 expected;
  const double a = 1.5, pi = std::numbers::pi;
  for (int i = 0; i < 2; ++i) {
    expected.segment<3>(11 * i).setConstant(6 * pi * a);
    expected.segment<3>(11 * i + 3).setConstant(8 * pi * a * a * a);
    expected.segment<5>(11 * i + 6).setConstant(20. / 3 * pi * a * a * a);
  }
  EXPECT_LT((R - PairMatrix(expected.asDiagonal())).norm(), 1e-7);  // 1/s = 3e-10 times 6 pi a ...
}

// A touching pair that moves as one body: singular terms cancel in every load, which tend to a limit as gap ln gap.
TEST(TwoSpherePair, RigidMotionOfATouchingPairNeedsFiniteLoads) {
  std::mt19937 random(4);
  const Vector3d e = random_direction(random), omega = random_direction(random), velocity = random_direction(random);
  for (const Radii& a : radii) {
    Vector22 previous = Vector22::Zero();
    for (const double gap : {1e-4, 1e-6, 1e-8}) {
      const PairMatrix R = two_sphere_pair((2 + gap) * e, a.one, a.two, 0);
      Vector22 motion = Vector22::Zero();
      motion.segment<3>(0) = velocity;
      motion.segment<3>(3) = omega;
      motion.segment<3>(11) = velocity + omega.cross((2 + gap) * e);
      motion.segment<3>(14) = omega;
      const Vector22 loads = R * motion;
      if (gap < 1e-4) {
        EXPECT_LT((loads - previous).norm(), gap == 1e-6 ? 0.2 : 4e-3) << gap << " " << a.one;
      }
      previous = loads;
    }
  }
}

// The truncated (Galerkin) resistance is a lower bound of the exact one, with which it shares basis and signs, and
// meets it as 1/s^6: the first multipole that it leaves out is induced as 1/s^3 and acts back as 1/s^3.
TEST(TwoSpherePair, IsBoundedBelowByTheFarFieldAndTendsToIt) {
  std::mt19937 random(5);
  for (const Radii& a : radii)
    for (const double gap : {1e-6, 1e-3, 0.1, 1.0, 10.0, 40.0}) {
      const Vector3d r = (2 + gap) * random_direction(random);
      const Eigen::MatrixXd R = two_sphere_pair(r, a.one, a.two, 0);
      const Eigen::MatrixXd far = Eigen::MatrixXd(far_field_pair(r, a.one, a.two)).inverse(), rest = R - far;
      // 1e-8: truncation of the table for unequal spheres.
      EXPECT_GT(rest.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-8 * far.norm())
          << gap << " " << a.one;
      if (gap >= 10) {
        EXPECT_LT(rest.norm(), (3 * std::pow(2 + gap, -6) + 3e-9) * far.norm()) << gap << " " << a.one;
      }
    }
}

TEST(TwoSpherePair, RefusesCoincidentCentres) {
  EXPECT_THROW(two_sphere_pair(Vector3d::Zero(), 1, 1), std::invalid_argument);
}

// Closed forms of mobility that hold exactly far away (s = 200, next terms 1e-7 relative to the leading one).
TEST(TwoSphereMobility, FarFieldIsRotnePragerAndFaxen) {
  const double s = 200;
  const MobilityScalars m = two_sphere_mobility(s - 2);
  EXPECT_NEAR(m.xa12, 3 / (2 * s) - 1 / (s * s * s), 1e-11);
  EXPECT_NEAR(m.ya12, 3 / (4 * s) + 1 / (2 * s * s * s), 1e-11);
  EXPECT_NEAR(m.yb12, -3 / (4 * s * s), 1e-10);
  EXPECT_NEAR(m.xc12, 3 / (4 * s * s * s), 1e-11);
  EXPECT_NEAR(m.yc12, -3 / (8 * s * s * s), 1e-11);
  EXPECT_NEAR(m.xm11, 10. / 9, 1e-6);
}

// Two spheres pushed along their axis: mobility of equal or opposite forces is one over the resistance of equal or
// opposite velocities.
TEST(TwoSphereMobility, InvertsTheResistance) {
  for (const double gap : gaps) {
    const MobilityScalars m = two_sphere_mobility(gap);
    const ResistanceScalars f = two_sphere_resistance(gap);
    const double round_off = 1e-13 + 1e-15 / gap;  // sums of numbers of size 1/gap
    EXPECT_NEAR((m.xa11 + m.xa12) * (f.XA11 + f.XA12), 1, round_off) << gap;
    EXPECT_NEAR((m.xa11 - m.xa12) * (f.XA11 - f.XA12), 1, round_off) << gap;
    EXPECT_NEAR((m.xc11 + m.xc12) * (f.XC11 + f.XC12), 1, 1e-13) << gap;
    EXPECT_NEAR((m.xg11 - m.xg12) * (f.XA11 - f.XA12), f.XG11 - f.XG12, round_off * f.XA11) << gap;
    EXPECT_EQ(m.zm11, f.ZM11) << gap;  // no motion of the spheres has this symmetry
  }
}

// The scalars put back into their tensors give the inverse of the resistance's motion part, unequal spheres included.
TEST(TwoSphereMobility, OfUnequalSpheresInvertsTheResistance) {
  const double gap = 0.3, ratio = 0.4;
  const MobilityScalars one = two_sphere_mobility(gap, ratio), two = two_sphere_mobility(gap, 1 / ratio);
  EXPECT_NEAR(one.xa12, two.xa12, 1e-8);
  EXPECT_NEAR(one.yc12, two.yc12, 1e-8);
  const ResistanceScalars f = two_sphere_resistance(gap, ratio), g = two_sphere_resistance(gap, 1 / ratio);
  Eigen::Matrix2d XA, xa;
  XA << f.XA11, f.XA12, g.XA12, g.XA11;
  xa << one.xa11, one.xa12, two.xa12, two.xa11;
  EXPECT_LT((XA * xa - Eigen::Matrix2d::Identity()).norm(), 1e-7);
  // Force and torque of both spheres across the axis: U_x and Omega_y, with e = z.
  Eigen::Matrix4d Y, y;
  Y << f.YA11, -f.YB11, f.YA12, g.YB12,  //
      -f.YB11, f.YC11, -f.YB12, f.YC12,  //
      f.YA12, -f.YB12, g.YA11, g.YB11,   //
      g.YB12, f.YC12, g.YB11, g.YC11;
  y << one.ya11, -one.yb11, one.ya12, two.yb12,  //
      -one.yb11, one.yc11, -one.yb12, one.yc12,  //
      one.ya12, -one.yb12, two.ya11, two.yb11,   //
      two.yb12, one.yc12, two.yb11, two.yc11;
  EXPECT_LT((Y * y - Eigen::Matrix4d::Identity()).norm(), 1e-7);
}

}  // namespace
}  // namespace crumble
