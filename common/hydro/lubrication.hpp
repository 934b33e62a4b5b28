// Pair lubrication added to the far field, for spheres that move relative to their neighbours.
//
// Both forms start from what the far field misses of one isolated pair, R_2B - R_2B,inf (exact two-sphere resistance
// minus the inverse of the pair's far-field mobility), a positive semi-definite 22 x 22 matrix since the far field is a
// lower bound.
//   as in Eq. 9 of the paper (Durlofsky, Brady & Bossis 1987):  R = M_inf^-1 + sum of pairs R_2B - R_2B,inf
//     Exact for two spheres. In a cluster the finite part acts on the collective motion of every near pair and adds up.
//   relative:                                                   R = M_inf^-1 + sum of pairs S(R_2B) - S(R_2B,inf)
//     S(R) = R - R Z (Z^T R Z)^-1 Z^T R is what the pair resists while it is free as a whole: its six rigid-body
//     motions, the columns of Z, adjust such that they bear no load. A rigid motion of the pair then meets no
//     lubrication, so a rigid cluster's drag is that of the far field; the loads between the spheres of a free doublet
//     in any linear flow are those of exact two-sphere hydrodynamics, whatever their radii; and the term stays positive
//     semi-definite, since S keeps the order of matrices (a Schur complement; both M_inf^-1 <= R_2B).
// Everything has the symmetry of the pair, so the term has the same eleven scalars as any pair's.
#pragma once

#include <Eigen/Sparse>
#include <string>
#include <vector>

#include "common/hydro/spheres.hpp"
#include "common/hydro/two_sphere_pair.hpp"

namespace crumble {

enum class PairMotion { all, relative };

struct LubricationPair {
  int i = 0, j = 0;
  PairMatrix resistance;  // viscosity 1, order (U, Omega, E')_i, (U, Omega, E')_j
};

// The 22 x 22 term of one pair. Pairs closer than the gap floor (overlaps included) are taken at the floor, with their
// own velocity fields continued to centres that far apart: then rigid motion and uniform strain of the pair still
// cancel the singular terms.
PairMatrix pair_lubrication(const Vector3& r, double a_1, double a_2, PairMotion motion,
                            double gap_floor = default_gap_floor);

// Empty if every pair closer than `range` mean radii is in the table of two-sphere functions, else what is wrong with
// the first that is not: "particles 0 and 7 have radii of 100 and 5 nm, 20 to 1; ...".
std::string outside_lubrication(const Spheres& spheres, double range);

// The sum over all pairs closer than `range` mean radii (of the pair).
class Lubrication {
 public:
  Lubrication() = default;
  Lubrication(const Spheres& spheres, double range, PairMotion motion, double gap_floor = default_gap_floor);

  bool empty() const { return pairs_.empty(); }
  const std::vector<LubricationPair>& pairs() const { return pairs_; }

  // q += D w on the layouts of hydrodynamics.hpp (six-vectors of motion, five-vectors of strain).
  void add(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain, Eigen::MatrixXd& q_motion,
           Eigen::MatrixXd& q_strain) const;

  // What D of the strain alone loads the motion with, six-vectors.
  Eigen::MatrixXd motion_loads_of_strain(int spheres, const Eigen::MatrixXd& w_strain) const;

  // Its motion-motion part, 6N x 6N, both triangles.
  Eigen::SparseMatrix<double> motion_resistance(int spheres) const;

 private:
  std::vector<LubricationPair> pairs_;
};

}  // namespace crumble
