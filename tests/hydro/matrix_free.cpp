// Iterations without a matrix give what a dense factor of the same configuration gives.
#include "common/hydro/matrix_free.hpp"

#include <gtest/gtest.h>

#include "clusters.hpp"
#include "common/hydro/dense_hydrodynamics.hpp"
#include "common/hydro/rigid_body.hpp"

namespace crumble::testing {
namespace {

Eigen::VectorXd wave(Eigen::Index n) {
  Eigen::VectorXd v(n);
  for (Eigen::Index k = 0; k < n; ++k) v[k] = std::sin(1.0 + 1.7 * static_cast<double>(k));
  return v;
}

constexpr Rung rungs[] = {Rung::fts, Rung::fts_lubrication, Rung::fts_relative_lubrication};

// Six spheres keep all that come before them: nothing is left out but the digits of float32.
TEST(SparseInverse, IsTheInverseWhereNothingIsLeftOut) {
  const Spheres s = octahedron();
  const Eigen::MatrixXd M = far_field_mobility(s).lower.selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd q = wave(66);
  EXPECT_LT((SparseInverse(s, 30).apply(M * q) - q).norm(), 1e-5 * q.norm());
}

// Positive definite also where a sphere keeps one other only, and for unequal radii.
TEST(SparseInverse, IsSymmetricAndPositiveDefinite) {
  const Spheres s = random_spheres(20, 8, 3, 1, 4);
  const SparseInverse inverse(s, 1);
  Eigen::MatrixXd P(220, 220);
  for (int k = 0; k < 220; ++k) P.col(k) = inverse.apply(Eigen::VectorXd::Unit(220, k));
  EXPECT_LT((P - P.transpose()).norm(), 1e-6 * P.norm());  // float32
  EXPECT_GT(P.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
}

TEST(MatrixFree, ResistanceIsThatOfTheDenseFactor) {
  for (const Spheres& s : {grown({150, 0, 1e9, 12, 0, 1}), random_spheres(40, 14, 5, 1, 3)})
    for (const Rung rung : rungs) {
      const HydroModel model{rung};
      const Eigen::VectorXd velocity = wave(6 * s.size());
      const MatrixFreeHydrodynamics free(s, 0.7, model, {.tolerance = 1e-10});
      const SphereLoads found = free.resistance(velocity, simple_shear(1.3));
      const SphereLoads exact = DenseHydrodynamics(s, 0.7, model).resistance(velocity, simple_shear(1.3));
      // Condition number of the mobility, 1e2, times the tolerance.
      EXPECT_LT((found.force_torque - exact.force_torque).norm(), 1e-8 * exact.force_torque.norm());
      EXPECT_LT((found.stresslet - exact.stresslet).norm(), 1e-8 * exact.stresslet.norm());
    }
}

TEST(MatrixFree, MobilityIsThatOfTheDenseFactor) {
  for (const Spheres& s : {grown({60, 0, 1e9, 12, 0, 1}), random_spheres(40, 14, 5, 1, 3)})
    for (const Rung rung : rungs) {
      const HydroModel model{rung};
      const Eigen::VectorXd load = wave(6 * s.size());
      const MatrixFreeHydrodynamics free(s, 0.7, model, {.tolerance = 1e-11});
      const SphereMotion found = free.mobility(load, simple_shear(1.3));
      const SphereMotion exact = DenseHydrodynamics(s, 0.7, model).mobility(load, simple_shear(1.3));
      EXPECT_LT((found.velocity - exact.velocity).norm(), 1e-9 * exact.velocity.norm());
      // Lubrication of a touching pair multiplies its relative motion, and the error of that, by 1e6.
      EXPECT_LT((found.stresslet - exact.stresslet).norm(), 1e-6 * exact.stresslet.norm());
    }
}

TEST(MatrixFree, FewIterationsSolveARigidBody) {
  const Spheres s = grown({300, 0, 1e9, 12, 0, 1});
  const MatrixFreeHydrodynamics free(s, 1, {}, {.tolerance = 1e-5});
  const RigidBodyResponse found = rigid_body_response(free, s.position, Vector3::Zero());
  const MatrixFreeHydrodynamics diagonal(s, 1, {}, {.tolerance = 1e-5, .neighbours = 0});
  rigid_body_response(diagonal, s.position, Vector3::Zero());
  EXPECT_LE(free.iterations(), 15);
  EXPECT_GT(diagonal.iterations(), 3 * free.iterations());
  const RigidBodyResponse exact = rigid_body_response(DenseHydrodynamics(s, 1, {}), s.position, Vector3::Zero());
  EXPECT_LT((found.drag - exact.drag).norm(), 1e-6 * exact.drag.norm());
}

TEST(MatrixFree, SaysThatItDoesNotConverge) {
  const Spheres s = grown({100, 0, 1e9, 12, 0, 1});
  const MatrixFreeHydrodynamics free(s, 1, {}, {.tolerance = 1e-12, .limit = 3});
  EXPECT_THROW(free.resistance(wave(600), {}), std::runtime_error);
  EXPECT_THROW(free.mobility(wave(600), {}), std::runtime_error);
  EXPECT_THROW(MatrixFreeHydrodynamics(s, 1, {Rung::multipole, 2}), std::invalid_argument);
}

}  // namespace
}  // namespace crumble::testing
