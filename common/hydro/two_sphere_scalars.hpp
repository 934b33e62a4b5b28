// The scalar functions that make up the resistance of two spheres, and their conventions.
#pragma once

#include <array>
#include <bit>

namespace crumble {

// Resistance scalars of sphere 1 of a pair: f11 couples to its own motion, f12 to the motion of sphere 2.
// Names and tensors as Jeffrey & Onishi 1984 (A, B, C) and Jeffrey 1992 (G, H, M); e points from sphere 1 to sphere 2,
// d is the identity, loads are exerted BY the particle ON the fluid, velocities are relative to the ambient flow and
// E' = -E (minus the ambient rate of strain), so that the matrix is symmetric and positive definite:
//   F_i  = [XA ee + YA (d - ee)]_ij U_j                    T_i  = YB eps_ijk U_j e_k
//   T_i  = [XC ee + YC (d - ee)]_ij Omega_j                S_ij = XG (ee - d/3)_ij e.U + YG (e_i U_j + U_i e_j - 2
//   ee_ij e.U) S_ij = YH (e_i eps_jkl + e_j eps_ikl) Omega_k e_l      S    = (XM P0 + YM P1 + ZM P2) : E'
// with P0, P1, P2 the orthogonal projectors on symmetric traceless tensors of axial order 0, 1, 2 about e; the first
// index is the sphere that carries T or S, the second the one that moves.
// Unit: every scalar is divided by 6 pi mu a^k with a = (a1+a2)/2 the mean radius, k = 1 for A, 2 for B and G, 3 for
// C, H and M. An isolated sphere of radius a has XA11 = YA11 = 1, XC11 = YC11 = 4/3, XM11 = YM11 = ZM11 = 10/9.
struct ResistanceScalars {
  double XA11 = 0, XA12 = 0, YA11 = 0, YA12 = 0, YB11 = 0, YB12 = 0, XC11 = 0, XC12 = 0, YC11 = 0, YC12 = 0;
  double XG11 = 0, XG12 = 0, YG11 = 0, YG12 = 0, YH11 = 0, YH12 = 0;
  double XM11 = 0, XM12 = 0, YM11 = 0, YM12 = 0, ZM11 = 0, ZM12 = 0;

  static constexpr int count = 22;
  static constexpr std::array<const char*, count> names = {
      "XA11", "XA12", "YA11", "YA12", "YB11", "YB12", "XC11", "XC12", "YC11", "YC12", "XG11",
      "XG12", "YG11", "YG12", "YH11", "YH12", "XM11", "XM12", "YM11", "YM12", "ZM11", "ZM12"};
  static ResistanceScalars from(const std::array<double, count>& f) { return std::bit_cast<ResistanceScalars>(f); }
  std::array<double, count> values() const { return std::bit_cast<std::array<double, count>>(*this); }
};

}  // namespace crumble
