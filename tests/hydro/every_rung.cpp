// Identities that hold exactly on every rung of the ladder, but for the known failures of the printed sum.
#include <gtest/gtest.h>

#include <numbers>

#include "clusters.hpp"
#include "common/hydro/dense_hydrodynamics.hpp"
#include "common/hydro/rigid_body.hpp"

namespace crumble::testing {
namespace {

using std::numbers::pi;

class EveryRung : public ::testing::TestWithParam<HydroModel> {
 protected:
  RigidBodyResponse response(const Spheres& s, const Vector3& centre = Vector3::Zero(), double viscosity = 1) const {
    return rigid_body_response(DenseHydrodynamics(s, viscosity, GetParam()), s.position, centre);
  }
};

INSTANTIATE_TEST_SUITE_P(Ladder, EveryRung,
                         ::testing::Values(HydroModel{Rung::fts}, HydroModel{Rung::fts_lubrication},
                                           HydroModel{Rung::fts_relative_lubrication}, HydroModel{Rung::multipole, 3}),
                         [](const auto& model) -> std::string {
                           switch (model.param.rung) {
                             case Rung::fts:
                               return "Fts";
                             case Rung::fts_lubrication:
                               return "FtsLubrication";
                             case Rung::fts_relative_lubrication:
                               return "FtsRelativeLubrication";
                             case Rung::multipole:
                               break;
                           }
                           return "Multipole";
                         });

// The Cholesky factors exist, and so loads that move spheres do work on them.
TEST_P(EveryRung, IsPositiveDefiniteOnHardConfigurations) {
  for (const Spheres& s :
       {random_spheres(30, 7.5, 1), random_spheres(30, 8.2, 3, 0.97), chain(12, 2 + 1e-8), chain(12),
        chain(12, 2 * (1 - 9e-3)), octahedron(), grown({30, 0, 1e9, 12, 0, 1}), random_spheres(10, 20, 5, 1, 10)}) {
    const DenseHydrodynamics hydro(s, 1, GetParam());
    const Eigen::VectorXd loads = wave(6 * s.size());
    EXPECT_LT(loads.dot(hydro.mobility(loads, {}).velocity.col(0)), 0);
    EXPECT_LT(loads.dot(hydro.resistance(loads, {}).force_torque.col(0)), 0);
  }
}

Eigen::Matrix3d some_rotation() {
  return Eigen::AngleAxisd(1.1, Vector3(0.3, -0.7, 0.6).normalized()).toRotationMatrix();
}

Spheres transformed(Spheres s, const Eigen::Matrix3d& Q) {
  for (auto& x : s.position) x = Q * x;
  return s;
}

TEST_P(EveryRung, RotatesReflectsPermutesAndScalesWithTheConfiguration) {
  const Spheres s = random_spheres(8, 6, 11, 1, 2);
  const LinearFlow flow = {Vector3(1, 2, 3), (Eigen::Matrix3d() << 1, 2, 0, 0.5, -3, 1, 4, 1, 2).finished()};
  const RigidBodyResponse r = response(s);
  const Eigen::VectorXd loads = r.loads(flow);
  for (const double sign : {1.0, -1.0}) {
    const Eigen::Matrix3d Q = sign * some_rotation();  // torques are pseudo-vectors
    const LinearFlow turned = {Q * flow.velocity, Q * flow.gradient * Q.transpose()};
    const Spheres t = transformed(s, Q);
    const Eigen::VectorXd found = response(t).loads(turned);
    for (int i = 0; i < 8; ++i) {
      EXPECT_LT((found.segment<3>(6 * i) - Q * loads.segment<3>(6 * i)).norm(), 1e-11 * loads.norm());
      EXPECT_LT((found.segment<3>(6 * i + 3) - sign * Q * loads.segment<3>(6 * i + 3)).norm(), 1e-11 * loads.norm());
    }
  }
  Spheres permuted = s;
  std::swap(permuted.position[0], permuted.position[5]);
  std::swap(permuted.radius[0], permuted.radius[5]);
  const Eigen::VectorXd swapped = response(permuted).loads(flow);
  EXPECT_LT((swapped.segment<6>(0) - loads.segment<6>(30)).norm(), 1e-11 * loads.norm());
  const Spheres large = scaled(s, 1e-7);  // SI: forces scale as length^2, torques as length^3
  const Eigen::VectorXd si = response(large, Vector3::Zero(), 1e-3).loads(flow);
  for (int i = 0; i < 8; ++i) {
    EXPECT_LT((si.segment<3>(6 * i) * 1e17 - loads.segment<3>(6 * i)).norm(), 1e-11 * loads.norm());
    EXPECT_LT((si.segment<3>(6 * i + 3) * 1e24 - loads.segment<3>(6 * i + 3)).norm(), 1e-11 * loads.norm());
  }
}

TEST_P(EveryRung, DecaysLikeAStokesletOfTheWholeCluster) {
  // A distant sphere sees the force on a small cluster only: u = F (1 + ee)/(8 pi r) + O(r^-2).
  Spheres s = triangle();
  const double r = 1e4;
  s.position.emplace_back(0, 0, r);
  s.radius.push_back(1);
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(24);
  for (int i = 0; i < 3; ++i) loads.segment<3>(6 * i) = Vector3(-1, 0, -1);
  const Eigen::VectorXd u = DenseHydrodynamics(s, 1, GetParam()).mobility(loads, {}).velocity;
  const double across = u[18] * 8 * pi * r / 3, along = u[20] * 8 * pi * r / 6;
  if (GetParam().rung == Rung::fts_lubrication) {
    // As printed, the lubrication of collective motion carries a part of the loads that the far field does not hear of.
    EXPECT_LT(across, 0.99);
    EXPECT_LT(along, 0.99);
    return;
  }
  EXPECT_NEAR(across, 1, 2 / r);
  EXPECT_NEAR(along, 1, 2 / r);
}

TEST_P(EveryRung, SumOfLoadsVanishesOnTheFreeBodyAndIsTheDragOnTheHeldOne) {
  const Spheres s = random_spheres(15, 7, 4, 1, 3);
  const RigidBodyResponse r = response(s, Vector3(1, 2, 3));
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
  for (int i = 0; i < 15; ++i) {
    const Vector3 f = r.free_loads.col(3).segment<3>(6 * i);
    force += f;
    torque += r.free_loads.col(3).segment<3>(6 * i + 3) + (s.position[i] - r.centre).cross(f);
  }
  EXPECT_LT(force.norm(), 1e-11 * r.free_loads.norm());
  EXPECT_LT(torque.norm(), 1e-11 * r.free_loads.norm());
  EXPECT_LT((r.drag - r.drag.transpose()).norm(), 1e-12 * r.drag.norm());
}

// Reciprocal theorem: the force by a strain on the held body is the stresslet of the moving body.
TEST_P(EveryRung, StrainAndMotionAreReciprocal) {
  const Spheres s = random_spheres(15, 7, 4, 1, 3);
  const DenseHydrodynamics hydro(s, 1, GetParam());
  const RigidBodyResponse r = response(s);
  Eigen::MatrixXd translation = Eigen::MatrixXd::Zero(90, 1);
  for (int i = 0; i < 15; ++i) translation(6 * i) = 1;
  const SphereLoads loads = hydro.relative_resistance(translation, Eigen::MatrixXd::Zero(5, 1));
  Vector5 stresslet = Vector5::Zero();  // of the body: of each sphere, and the moments of the forces
  for (int i = 0; i < 15; ++i)
    stresslet += loads.stresslet.middleRows(5 * i, 5) +
                 strain_along(s.position[i]).transpose() * loads.force_torque.middleRows(6 * i, 3);
  // F_x = strain_drag E, S = -(strain_drag row)^T U: power of both problems agrees (Lorentz).
  EXPECT_LT((stresslet + r.strain_drag.row(0).transpose()).norm(), 1e-11 * stresslet.norm());
}

// The printed sum breaks the upper bound on larger clusters (lubrication.cpp), not yet on these.
TEST_P(EveryRung, DragLiesBetweenAnEnclosedAndTheEnclosingSphere) {
  const double h = std::sqrt(3.0);
  const std::vector<std::pair<Spheres, double>> cases = {{chain(2), 2},
                                                         {chain(4), 4},
                                                         {triangle(), 1 + 2 / h},
                                                         {tetrahedron(), 1 + std::sqrt(1.5)},
                                                         {octahedron(), 1 + std::sqrt(2.0)}};
  for (const auto& [s, enclosing] : cases) {
    const RigidBodyResponse r = response(s);
    const Eigen::Vector3d drag =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(r.drag.topLeftCorner<3, 3>()).eigenvalues() / (6 * pi);
    EXPECT_GT(drag[0], 1);
    EXPECT_LT(drag[2], enclosing);
  }
}

}  // namespace
}  // namespace crumble::testing
