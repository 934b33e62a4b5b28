#include "common/hydro/lubrication.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/hydro/far_field.hpp"
#include "common/hydro/two_sphere.hpp"

namespace crumble {

namespace {

// With the axis along z the 22 x 22 matrix falls apart by order m of rotation about it. Per sphere:
//   m = 0: U_z, E_2 | Omega_z      m = 1: U_x, Omega_y, E_3      m = 2: E_4
// and the partners (U_y, ...) repeat these by symmetry.
constexpr std::array<int, 4> stretching = {2, 8, 13, 19};
constexpr std::array<int, 2> spinning = {5, 16};
constexpr std::array<int, 6> shearing = {0, 4, 9, 11, 15, 20};
constexpr std::array<int, 2> straining = {10, 21};

template <std::size_t n>
using Square = Eigen::Matrix<double, static_cast<int>(n), static_cast<int>(n)>;

template <std::size_t n>
Square<n> part(const PairMatrix& R, const std::array<int, n>& rows) {
  Square<n> result;
  for (std::size_t p = 0; p < n; ++p)
    for (std::size_t q = 0; q < n; ++q) result(p, q) = R(rows[p], rows[q]);
  return result;
}

// What a pair resists if it is free as a whole: its rigid motions Z adjust such that they bear no load,
//   R - R Z (Z^T R Z)^-1 Z^T R.
template <std::size_t n, int m>
Square<n> free_as_a_whole(const Square<n>& R, const Eigen::Matrix<double, static_cast<int>(n), m>& Z) {
  const Eigen::Matrix<double, static_cast<int>(n), m> loads = R * Z;
  return R - loads * (Z.transpose() * loads).inverse() * loads.transpose();
}

template <std::size_t n, int m>
Square<n> excess(const PairMatrix& exact, const PairMatrix& far_field, const std::array<int, n>& rows,
                 PairMotion motion, const Eigen::Matrix<double, static_cast<int>(n), m>& rigid) {
  const Square<n> near = part(exact, rows), far = part(far_field, rows).llt().solve(Square<n>::Identity());
  if constexpr (m > 0) {
    if (motion == PairMotion::relative) return free_as_a_whole<n, m>(near, rigid) - free_as_a_whole<n, m>(far, rigid);
  }
  return near - far;
}

struct AxialBlocks {
  Square<4> stretch;
  Square<2> spin;
  Square<6> shear;
  Square<2> strain;
};

// Velocities of the pair at the floor from those of the pair itself: the centres are moved apart by 2 `shift` along z,
// each sphere's velocity field (rigid plus minus the ambient strain) being continued. B_2 zz = 2/sqrt 6, B_3 xz =
// 1/sqrt 2.
void continue_to_floor(AxialBlocks& D, double shift) {
  Square<4> stretch = Square<4>::Identity();
  Square<6> shear = Square<6>::Identity();
  for (int s = 0; s < 2; ++s) {
    const double z = s == 0 ? -shift : shift;
    stretch(2 * s, 2 * s + 1) = 2 / std::sqrt(6.0) * z;
    shear(3 * s, 3 * s + 1) = z;  // (Omega x z)_x
    shear(3 * s, 3 * s + 2) = std::sqrt(0.5) * z;
  }
  D.stretch = stretch.transpose() * D.stretch * stretch;
  D.shear = shear.transpose() * D.shear * shear;
}

// The pair's scalars back from its blocks; inverse of two_sphere_pair for an axis along z.
ResistanceScalars scalars(const AxialBlocks& D, int s, double a) {
  const int t = 1 - s;
  const double A = 6 * std::numbers::pi * a, B = A * a, C = B * a, along = 2 / std::sqrt(6.0), across = std::sqrt(2.0);
  ResistanceScalars f;
  f.XA11 = D.stretch(2 * s, 2 * s) / A;
  f.XA12 = D.stretch(2 * s, 2 * t) / A;
  f.YA11 = D.shear(3 * s, 3 * s) / A;
  f.YA12 = D.shear(3 * s, 3 * t) / A;
  f.YB11 = -D.shear(3 * s + 1, 3 * s) / B;
  f.YB12 = -D.shear(3 * s + 1, 3 * t) / B;
  f.XC11 = D.spin(s, s) / C;
  f.XC12 = D.spin(s, t) / C;
  f.YC11 = D.shear(3 * s + 1, 3 * s + 1) / C;
  f.YC12 = D.shear(3 * s + 1, 3 * t + 1) / C;
  f.XG11 = D.stretch(2 * s + 1, 2 * s) / (B * along);
  f.XG12 = D.stretch(2 * s + 1, 2 * t) / (B * along);
  f.YG11 = D.shear(3 * s + 2, 3 * s) / (B * across);
  f.YG12 = D.shear(3 * s + 2, 3 * t) / (B * across);
  f.YH11 = D.shear(3 * s + 2, 3 * s + 1) / (C * across);
  f.YH12 = D.shear(3 * s + 2, 3 * t + 1) / (C * across);
  f.XM11 = D.stretch(2 * s + 1, 2 * s + 1) / C;
  f.XM12 = D.stretch(2 * s + 1, 2 * t + 1) / C;
  f.YM11 = D.shear(3 * s + 2, 3 * s + 2) / C;
  f.YM12 = D.shear(3 * s + 2, 3 * t + 2) / C;
  f.ZM11 = D.strain(s, s) / C;
  f.ZM12 = D.strain(s, t) / C;
  return f;
}

// All pairs closer than range times their mean radius, by a sweep along x.
std::vector<std::pair<int, int>> near_pairs(const Spheres& s, double range) {
  std::vector<int> order(s.position.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) { return s.position[i].x() < s.position[j].x(); });
  const double largest = *std::max_element(s.radius.begin(), s.radius.end());
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t p = 0; p < order.size(); ++p)
    for (std::size_t q = p + 1; q < order.size(); ++q) {
      const int i = order[p], j = order[q];
      const Vector3 d = s.position[j] - s.position[i];
      if (d.x() > range * 0.5 * (s.radius[i] + largest)) break;
      if (d.norm() < range * 0.5 * (s.radius[i] + s.radius[j])) pairs.emplace_back(std::min(i, j), std::max(i, j));
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Of a pair with its axis along z at the given distance.
AxialBlocks blocks_at(double distance, double a_1, double a_2, PairMotion motion, double gap_floor) {
  const Vector3 r = distance * Vector3::UnitZ();
  const PairMatrix exact = two_sphere_pair(r, a_1, a_2, gap_floor), far = far_field_pair(r, a_1, a_2);
  const double half = distance / 2;
  Eigen::Matrix<double, 6, 2> shearing_rigidly;  // U_x = V + omega_y z, z from half way
  shearing_rigidly << 1, -half, 0, 1, 0, 0, 1, half, 0, 1, 0, 0;
  const AxialBlocks D{
      excess<4, 1>(exact, far, stretching, motion, {1, 0, 1, 0}), excess<2, 1>(exact, far, spinning, motion, {1, 1}),
      excess<6, 2>(exact, far, shearing, motion, shearing_rigidly), excess<2, 0>(exact, far, straining, motion, {})};
  return D;
}

PairMatrix placed(AxialBlocks D, const Vector3& r, double distance, double apart, double a) {
  if (apart > distance) continue_to_floor(D, (apart - distance) / 2);
  return two_sphere_pair(r / distance, a, scalars(D, 0, a), scalars(D, 1, a));
}

}  // namespace

std::string outside_lubrication(const Spheres& s, double range) {
  for (const auto& [i, j] : near_pairs(s, range)) {
    const double ratio = s.radius[i] > s.radius[j] ? s.radius[i] / s.radius[j] : s.radius[j] / s.radius[i];
    if (!is_tabulated(ratio))
      return fmt::format(
          "particles {} and {} have radii of {:.4g} and {:.4g} nm, {:.3g} to 1; lubrication between near "
          "spheres is known up to 10 to 1",
          i, j, 1e9 * s.radius[i], 1e9 * s.radius[j], ratio);
  }
  return "";
}

PairMatrix pair_lubrication(const Vector3& r, double a_1, double a_2, PairMotion motion, double gap_floor) {
  const double distance = r.norm(), a = (a_1 + a_2) / 2, apart = effective_distance(distance, a, gap_floor);
  return placed(blocks_at(apart, a_1, a_2, motion, gap_floor), r, distance, apart, a);
}

Lubrication::Lubrication(const Spheres& s, double range, PairMotion motion, double gap_floor) {
  // Most near pairs of a dried cluster touch: at the floor all of the same radii have the same blocks.
  double a_1 = 0, a_2 = 0;
  AxialBlocks at_floor;
  for (const auto& [i, j] : near_pairs(s, range)) {
    const Vector3 r = s.position[j] - s.position[i];
    const double distance = r.norm(), a = (s.radius[i] + s.radius[j]) / 2;
    const double apart = effective_distance(distance, a, gap_floor);
    if (apart == distance) {
      pairs_.push_back({i, j, pair_lubrication(r, s.radius[i], s.radius[j], motion, gap_floor)});
      continue;
    }
    if (a_1 != s.radius[i] || a_2 != s.radius[j]) {
      a_1 = s.radius[i], a_2 = s.radius[j];
      at_floor = blocks_at(apart, a_1, a_2, motion, gap_floor);
    }
    pairs_.push_back({i, j, placed(at_floor, r, distance, apart, a)});
  }
}

void Lubrication::add(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& q_motion,
                      Eigen::MatrixXd& q_strain) const {
  Eigen::Matrix<double, 22, 1> w, q;
  for (const LubricationPair& p : pairs_)
    for (Eigen::Index c = 0; c < w_motion.cols(); ++c) {
      w << w_motion.col(c).segment<6>(6 * p.i), w_strain.col(c).segment<5>(5 * p.i),
          w_motion.col(c).segment<6>(6 * p.j), w_strain.col(c).segment<5>(5 * p.j);
      q.noalias() = p.resistance * w;
      q_motion.col(c).segment<6>(6 * p.i) += q.segment<6>(0);
      q_strain.col(c).segment<5>(5 * p.i) += q.segment<5>(6);
      q_motion.col(c).segment<6>(6 * p.j) += q.segment<6>(11);
      q_strain.col(c).segment<5>(5 * p.j) += q.segment<5>(17);
    }
}

Eigen::MatrixXd Lubrication::motion_loads_of_strain(int spheres, const Eigen::MatrixXd& w_strain) const {
  const Eigen::MatrixXd at_rest = Eigen::MatrixXd::Zero(6 * spheres, w_strain.cols());
  Eigen::MatrixXd loads = at_rest, stresslet = Eigen::MatrixXd::Zero(5 * spheres, w_strain.cols());
  add(at_rest, w_strain, loads, stresslet);
  return loads;
}

Eigen::SparseMatrix<double> Lubrication::motion_resistance(int spheres) const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(pairs_.size() * 144);
  for (const LubricationPair& p : pairs_)
    for (int s = 0; s < 2; ++s)
      for (int t = 0; t < 2; ++t)
        for (int row = 0; row < 6; ++row)
          for (int column = 0; column < 6; ++column)
            entries.emplace_back(6 * (s == 0 ? p.i : p.j) + row, 6 * (t == 0 ? p.i : p.j) + column,
                                 p.resistance(11 * s + row, 11 * t + column));
  Eigen::SparseMatrix<double> result(6 * spheres, 6 * spheres);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace crumble
