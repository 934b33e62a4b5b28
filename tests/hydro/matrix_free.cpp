// Iterations without a matrix give what a dense factor of the same configuration gives.
#include "common/hydro/matrix_free.hpp"

#include <gtest/gtest.h>

#include "clusters.hpp"
#include "common/hydro/dense_hydrodynamics.hpp"
#include "common/hydro/rigid_body.hpp"

namespace crumble::testing {
namespace {

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

TEST(MatrixFree, LoadsAndMotionsAreThoseOfTheDenseFactor) {
  const auto near = [](const Eigen::MatrixXd& found, const Eigen::MatrixXd& exact, double tolerance) {
    EXPECT_LT((found - exact).norm(), tolerance * exact.norm());
  };
  for (const Spheres& s : {grown({150, 0, 1e9, 12, 0, 1}), random_spheres(40, 14, 5, 1, 3)})
    for (const Rung rung : rungs) {
      SCOPED_TRACE(::testing::Message() << s.size() << " spheres, rung " << static_cast<int>(rung));
      const HydroModel model{rung};
      const LinearFlow flow = simple_shear(1.3);
      const Eigen::VectorXd known = wave(6 * s.size());
      const MatrixFreeHydrodynamics free(s, 0.7, model, {.tolerance = 1e-11});
      const DenseHydrodynamics dense(s, 0.7, model);
      // Condition number of the mobility, 1e2, times the tolerance.
      const SphereLoads loads = free.resistance(known, flow), exact_loads = dense.resistance(known, flow);
      near(loads.force_torque, exact_loads.force_torque, 1e-8);
      near(loads.stresslet, exact_loads.stresslet, 1e-8);
      // Lubrication of a touching pair multiplies its relative motion, and the error of that, by 1e6.
      const SphereMotion motion = free.mobility(known, flow), exact_motion = dense.mobility(known, flow);
      near(motion.velocity, exact_motion.velocity, 1e-9);
      near(motion.stresslet, exact_motion.stresslet, 1e-6);
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
