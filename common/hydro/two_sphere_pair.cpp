#include "common/hydro/two_sphere_pair.hpp"

#include <numbers>
#include <stdexcept>

namespace crumble {
namespace {

using Matrix3 = Eigen::Matrix3d;
using Matrix53 = Eigen::Matrix<double, 5, 3>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

// The tensors that e spans, in the basis of the pair matrix.
struct Axis {
  Matrix3 ee, across, cross;          // ee, d - ee, and v -> e x v
  Matrix53 axial, shear, twist;       // of G (X, Y) and H
  Matrix5 order_0, order_1, order_2;  // projectors of M
};

Axis axis(const Eigen::Vector3d& e) {
  Axis t;
  t.ee = e * e.transpose();
  t.across = Matrix3::Identity() - t.ee;
  t.cross << 0, -e.z(), e.y(), e.z(), 0, -e.x(), -e.y(), e.x(), 0;
  const Eigen::Matrix<double, 3, 5> along = strain_along(e);
  const Vector5 q = along.transpose() * e;
  t.axial = q * e.transpose();
  t.shear = 2 * (along.transpose() - t.axial);
  t.twist = -2 * along.transpose() * t.cross;
  t.order_0 = 1.5 * q * q.transpose();
  t.order_1 = 2 * (along.transpose() * along - q * q.transpose());
  t.order_2 = Matrix5::Identity() - t.order_0 - t.order_1;
  return t;
}

// The part that does not need its mirror image: loads of sphere `row` for the motion of sphere `column`, T and S for
// U and S for Omega included; the opposite couplings are their transposes in the mirror block.
void add_blocks(PairMatrix& R, int row, int column, const Axis& t, double a, double XA, double YA, double YB, double XC,
                double YC, double XG, double YG, double YH, double XM, double YM, double ZM) {
  const double A = 6 * std::numbers::pi * a, B = A * a, C = B * a;
  const int i = 11 * row, j = 11 * column;
  R.block<3, 3>(i, j) = A * (XA * t.ee + YA * t.across);
  R.block<3, 3>(i + 3, j) = -B * YB * t.cross;
  R.block<3, 3>(j, i + 3) = B * YB * t.cross;
  R.block<3, 3>(i + 3, j + 3) = C * (XC * t.ee + YC * t.across);
  R.block<5, 3>(i + 6, j) = B * (XG * t.axial + YG * t.shear);
  R.block<3, 5>(j, i + 6) = R.block<5, 3>(i + 6, j).transpose();
  R.block<5, 3>(i + 6, j + 3) = C * YH * t.twist;
  R.block<3, 5>(j + 3, i + 6) = R.block<5, 3>(i + 6, j + 3).transpose();
  R.block<5, 5>(i + 6, j + 6) = C * (XM * t.order_0 + YM * t.order_1 + ZM * t.order_2);
}

}  // namespace

PairMatrix two_sphere_pair(const Eigen::Vector3d& e, double a, const ResistanceScalars& one,
                           const ResistanceScalars& two) {
  const Axis t = axis(e);
  PairMatrix R;
  for (int s = 0; s < 2; ++s) {
    const ResistanceScalars& f = s == 0 ? one : two;
    add_blocks(R, s, s, t, a, f.XA11, f.YA11, f.YB11, f.XC11, f.YC11, f.XG11, f.YG11, f.YH11, f.XM11, f.YM11, f.ZM11);
    add_blocks(R, s, 1 - s, t, a, f.XA12, f.YA12, f.YB12, f.XC12, f.YC12, f.XG12, f.YG12, f.YH12, f.XM12, f.YM12,
               f.ZM12);
  }
  // Unequal spheres: XA12 and its like were interpolated twice, at a2/a1 and at a1/a2.
  const Eigen::Matrix<double, 11, 11> coupling =
      (R.topRightCorner<11, 11>() + R.bottomLeftCorner<11, 11>().transpose()) / 2;
  R.topRightCorner<11, 11>() = coupling;
  R.bottomLeftCorner<11, 11>() = coupling.transpose();
  return R;
}

PairMatrix two_sphere_pair(const Eigen::Vector3d& r, double a_1, double a_2, double gap_floor) {
  const double distance = r.norm(), a = (a_1 + a_2) / 2;
  if (!(distance > 0)) throw std::invalid_argument("two_sphere_pair: the centres of two spheres coincide");
  const double gap = effective_gap(distance / a - 2, gap_floor);
  const ResistanceScalars one = two_sphere_resistance(gap, a_2 / a_1);
  return two_sphere_pair(r / distance, a, one, swapped(a_1 == a_2 ? one : two_sphere_resistance(gap, a_1 / a_2)));
}

MobilityScalars two_sphere_mobility(double gap, double radius_ratio) {
  const ResistanceScalars one = two_sphere_resistance(gap, radius_ratio);
  const ResistanceScalars two = swapped(radius_ratio == 1 ? one : two_sphere_resistance(gap, 1 / radius_ratio));
  const PairMatrix R = two_sphere_pair(Eigen::Vector3d::UnitZ(), 1, one, two) / (6 * std::numbers::pi);
  // Motion (U, Omega of both) and strain (E' of both) apart.
  Eigen::Matrix<double, 12, 12> K;
  Eigen::Matrix<double, 10, 12> L;
  Eigen::Matrix<double, 10, 10> M;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      K.block<6, 6>(6 * i, 6 * j) = R.block<6, 6>(11 * i, 11 * j);
      L.block<5, 6>(5 * i, 6 * j) = R.block<5, 6>(11 * i + 6, 11 * j);
      M.block<5, 5>(5 * i, 5 * j) = R.block<5, 5>(11 * i + 6, 11 * j + 6);
    }
  const Eigen::LLT<Eigen::Matrix<double, 12, 12>> factor(K);
  const Eigen::Matrix<double, 12, 12> m = factor.solve(Eigen::Matrix<double, 12, 12>::Identity());
  const Eigen::Matrix<double, 10, 12> g = L * m;
  const Eigen::Matrix<double, 10, 10> s = M - g * L.transpose();
  // With e = z: axial entries are zz, transverse ones act in the plane of x and z; B_2, B_3, B_4 of the strain basis.
  const double axial = std::sqrt(2.0 / 3.0), shear = std::sqrt(2.0);
  return {.xa11 = m(2, 2),
          .xa12 = m(2, 8),
          .ya11 = m(0, 0),
          .ya12 = m(0, 6),
          .yb11 = -m(4, 0),
          .yb12 = -m(4, 6),
          .xc11 = m(5, 5),
          .xc12 = m(5, 11),
          .yc11 = m(4, 4),
          .yc12 = m(4, 10),
          .xg11 = g(2, 2) / axial,
          .xg12 = g(2, 8) / axial,
          .yg11 = g(3, 0) / shear,
          .yg12 = g(3, 6) / shear,
          .yh11 = g(3, 4) / shear,
          .yh12 = g(3, 10) / shear,
          .xm11 = s(2, 2),
          .xm12 = s(2, 7),
          .ym11 = s(3, 3),
          .ym12 = s(3, 8),
          .zm11 = s(4, 4),
          .zm12 = s(4, 9)};
}

}  // namespace crumble
