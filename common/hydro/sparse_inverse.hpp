// A sparse factor of the inverse of the far-field mobility, made from small dense problems around every sphere.
//
// Spheres are ordered from coarse to fine: each next one is the farthest from all before it, l_i its distance to them.
// Sphere i keeps those before it within a few l_i. With S = (those, i) and the Cholesky factor M_SS = C C^T, its
// columns
//   L_i = C^-T (0, 1)^T
// of the factor M^-1 ~ sum_i L_i L_i^T minimise the Kullback-Leibler divergence among all factors of that sparsity. It
// is positive definite whatever is left out; since long wave lengths live on the coarse spheres, it holds them too,
// which a factor of near pairs alone does not. It needs no fill-in and hence no further ordering.
//   Source: Vecchia 1988; Schaefer, Katzfuss & Owhadi 2021 SIAM J. Sci. Comput. 43, A2019.
#pragma once

#include <vector>

#include "common/hydro/far_field.hpp"

namespace crumble {

class SparseInverse {
 public:
  // neighbours: most spheres that one keeps.
  explicit SparseInverse(const Spheres& spheres, int neighbours);

  // z = L L^T r, vectors of 11N in the order of MobilityMatrix.
  Eigen::VectorXd apply(const Eigen::VectorXd& r) const;

 private:
  struct Columns {
    std::vector<int> sphere;  // the last one is the sphere itself
    Eigen::MatrixXf value;    // 11 rows a sphere, 11 columns
  };
  std::vector<Columns> columns_;
};

}  // namespace crumble
