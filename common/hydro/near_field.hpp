// Lubrication singularities of the two-sphere resistance scalars as the gap closes.
#pragma once

#include <array>

#include "common/hydro/two_sphere_scalars.hpp"

namespace crumble {

// One scalar's singular part  inverse / xi + log ln(1/xi) + xi_log xi ln(1/xi).
template <class T>
struct SingularForm {
  T inverse, log, xi_log;
};

// The singular parts of all scalars for the radius ratio lambda = a2/a1, in the order and unit of ResistanceScalars;
// xi is the gap over the mean radius. What is left after subtraction is finite, with a finite slope, at contact:
// its next singularity is xi^2 ln xi.
//   Source: Jeffrey & Onishi 1984 J. Fluid Mech. 139, 261 (A, B, C); Jeffrey 1992 Phys. Fluids A 4, 16 (G, H, M).
//   Every coefficient was checked against the series of two_sphere_series.hpp for lambda = 0.1, 0.5, 1, 2, 10 by
//   fits of 1e-7; the term xi ln xi of YM12 and of ZM is the one that the series gives.
template <class T>
constexpr std::array<SingularForm<T>, ResistanceScalars::count> near_field(T lambda) {
  const T l = lambda, l2 = l * l, l3 = l2 * l, l4 = l2 * l2, s = 1 + l, s2 = s * s, s3 = s2 * s;
  const T a = 2 / s;  // radius of sphere 1 over the mean radius
  // Units in which the sources give sphere 1: 6 pi a1, 4 pi a1^2, 8 pi a1^3, 20/3 pi a1^3; here all over 6 pi.
  const T A = a, B = a * a * 2 / 3, C = a * a * a * 4 / 3, M = a * a * a * 10 / 9;
  const auto form = [](T unit, T inverse, T log, T xi_log) {
    return SingularForm<T>{unit * inverse, unit * log, unit * xi_log};
  };
  const auto minus = [](const SingularForm<T>& f) { return SingularForm<T>{-f.inverse, -f.log, -f.xi_log}; };

  const auto XA =
      form(A, 2 * l2 / s3, l * (1 + 7 * l + l2) / (5 * s3), (1 + 18 * l - 29 * l2 + 18 * l3 + l4) / (42 * s3));
  const auto YA =
      form(A, 0, 4 * l * (2 + l + 2 * l2) / (15 * s3), 2 * (16 - 45 * l + 58 * l2 - 45 * l3 + 16 * l4) / (375 * s3));
  const auto YB = form(B, 0, -l * (4 + l) / (5 * s2), -(32 - 33 * l + 83 * l2 + 43 * l3) / (250 * s2));
  const auto XC = form(C, 0, 0, -l2 / (4 * s));
  const auto YC11 = form(C, 0, 2 * l / (5 * s), (8 + 6 * l + 33 * l2) / (125 * s));
  const auto YC12 = form(C, 0, l2 / (10 * s), l * (43 - 24 * l + 43 * l2) / (500 * s));
  const auto XG = form(B, 3 * l2 / s3, 3 * l * (1 + 12 * l - 4 * l2) / (10 * s3),
                       (5 + 181 * l - 453 * l2 + 566 * l3 - 65 * l4) / (140 * s3));
  const auto YG =
      form(B, 0, l * (4 - l + 7 * l2) / (10 * s3), (32 - 179 * l + 532 * l2 - 356 * l3 + 221 * l4) / (500 * s3));
  const auto YH11 = form(C, 0, l * (2 - l) / (10 * s2), (16 - 61 * l + 180 * l2 + 2 * l3) / (500 * s2));
  const auto YH12 = form(C, 0, l2 * (1 + 7 * l) / (20 * s2), l * (43 + 147 * l - 185 * l2 + 221 * l3) / (1000 * s2));
  const auto XM11 = form(M, 6 * l2 / (5 * s3), 3 * l * (1 + 17 * l - 9 * l2) / (25 * s3),
                         (5 + 272 * l - 831 * l2 + 1322 * l3 - 415 * l4) / (350 * s3));
  const auto XM12 = form(M, 6 * l3 / (5 * s3), 3 * l2 * (-4 + 17 * l - 4 * l2) / (25 * s3),
                         l * (-65 + 832 * l - 1041 * l2 + 832 * l3 - 65 * l4) / (350 * s3));
  const auto YM11 =
      form(M, 0, 6 * l * (1 - l + 4 * l2) / (25 * s3), (24 - 201 * l + 882 * l2 - 1182 * l3 + 591 * l4) / (625 * s3));
  const auto YM12 = form(M, 0, 3 * l2 * (7 - 10 * l + 7 * l2) / (50 * s3),
                         3 * l * (221 - 748 * l + 1902 * l2 - 748 * l3 + 221 * l4) / (2500 * s3));
  const auto ZM = form(M, 0, 0, -3 * (l2 + l4) / (10 * s3));
  return {XA,        minus(XA), YA,        minus(YA), YB,   minus(YB), XC,   minus(XC), YC11, YC12, XG,
          minus(XG), YG,        minus(YG), YH11,      YH12, XM11,      XM12, YM11,      YM12, ZM,   minus(ZM)};
}

}  // namespace crumble
