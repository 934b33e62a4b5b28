// Far-field force-torque-stresslet hydrodynamics: exact identities and known errors.
#include "common/hydro/far_field.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "clusters.hpp"
#include "common/hydro/dense_hydrodynamics.hpp"
#include "common/hydro/rigid_body.hpp"

namespace crumble::testing {
namespace {

using std::numbers::pi;
constexpr double round_off = 1e-12;

Eigen::MatrixXd full(const MobilityMatrix& M) { return M.lower.selfadjointView<Eigen::Lower>(); }

TEST(StrainBasis, IsOrthonormalAndReversible) {
  for (int k = 0; k < 5; ++k) {
    const Eigen::Matrix3d B = strain_tensor(Vector5::Unit(k));
    EXPECT_NEAR(B.trace(), 0, round_off);
    for (int l = 0; l < 5; ++l)
      EXPECT_NEAR(B.cwiseProduct(strain_tensor(Vector5::Unit(l))).sum(), k == l ? 1 : 0, round_off);
    EXPECT_LT((strain_components(B) - Vector5::Unit(k)).norm(), round_off);
    EXPECT_LT((strain_along(Vector3(1, 2, 3)).col(k) - B * Vector3(1, 2, 3)).norm(), round_off);
  }
}

TEST(FarField, OneSphereHasTheLoadsOfStokes) {
  Spheres s;
  s.position = {{3e-7, -2e-7, 1e-7}};
  s.radius = {1e-7};
  const double a = 1e-7, mu = 1e-3;
  LinearFlow flow;
  flow.velocity = Vector3(1, 2, 3) * 1e-6;
  flow.gradient << 1, 2, 3, 4, 5, 6, 7, 8, -6;
  Eigen::VectorXd velocity(6);
  velocity << 1e-6, 5e-6, -2e-6, 3, -2, 1;
  const SphereLoads loads = DenseHydrodynamics(s, mu, {}).resistance(velocity, flow);
  const Vector3 F = -6 * pi * mu * a * (velocity.head<3>() - flow.velocity_at(s.position[0]));
  const Vector3 T = -8 * pi * mu * a * a * a * (velocity.tail<3>() - flow.angular_velocity());
  const Vector5 S = 20.0 / 3 * pi * mu * a * a * a * flow.strain();
  EXPECT_LT((loads.force_torque.topRows(3) - F).norm(), round_off * F.norm());
  EXPECT_LT((loads.force_torque.bottomRows(3) - T).norm(), round_off * T.norm());
  EXPECT_LT((loads.stresslet - S).norm(), round_off * S.norm());
}

// The matrix is stored as one triangle; here the two halves come from pair terms computed in both directions.
TEST(FarField, PairTermsAreReciprocal) {
  const Vector3 r(1.3, -2.1, 0.7);
  const PairMobility there = pair_mobility(r, 1, 0.4), back = pair_mobility(-r, 0.4, 1);
  EXPECT_LT((there.motion_force - back.motion_force.transpose()).norm(), round_off);
  EXPECT_LT((there.motion_stresslet - back.strain_force.transpose()).norm(), round_off);
  EXPECT_LT((there.strain_stresslet - back.strain_stresslet.transpose()).norm(), round_off);
}

// Faxen: the terms without radii are derivatives of the Stokeslet, taken here by differences.
TEST(FarField, PointTermsAreDerivativesOfTheStokeslet) {
  const Vector3 r(1.3, -2.1, 0.7);
  const auto G = [](const Vector3& x) {
    return Eigen::Matrix3d((Eigen::Matrix3d::Identity() + x * x.transpose() / x.squaredNorm()) / (8 * pi * x.norm()));
  };
  const double small = 1e-7, h = 1e-4;  // h^2 truncation 1e-8, radii negligible
  const PairMobility m = pair_mobility(r, small, small);
  EXPECT_LT((m.motion_force.topLeftCorner<3, 3>() - G(r)).norm(), 1e-10);
  for (int k = 0; k < 5; ++k) {
    const Eigen::Matrix3d B = strain_tensor(Vector5::Unit(k));
    Vector3 u = Vector3::Zero();
    Vector5 e = Vector5::Zero();
    Vector3 w = Vector3::Zero();
    for (int c = 0; c < 3; ++c) {
      const Vector3 d = h * Vector3::Unit(c);
      const Eigen::Matrix3d slope = (G(r + d) - G(r - d)) / (2 * h);
      u -= slope * B.col(c);  // point dipole of strength B
      for (int b = 0; b < 3; ++b) e[b] += B.row(c) * slope.col(b);
    }
    EXPECT_LT((m.motion_stresslet.topRows<3>().col(k) - u).norm(), 1e-8);
    EXPECT_LT((m.strain_force.row(k).head<3>().transpose() - e.head<3>()).norm(), 1e-8);
    // Vorticity and strain of the dipole field by differences of m itself.
    Eigen::Matrix3d gradient;
    for (int c = 0; c < 3; ++c) {
      const Vector3 d = h * Vector3::Unit(c);
      gradient.col(c) = (pair_mobility(r + d, small, small).motion_stresslet.topRows<3>().col(k) -
                         pair_mobility(r - d, small, small).motion_stresslet.topRows<3>().col(k)) /
                        (2 * h);
    }
    w = LinearFlow{Vector3::Zero(), gradient}.angular_velocity();
    EXPECT_LT((m.motion_stresslet.bottomRows<3>().col(k) - w).norm(), 1e-8);
    EXPECT_LT((m.strain_stresslet.col(k) - strain_components(gradient)).norm(), 1e-8);
  }
}

TEST(FarField, IsPositiveDefiniteOnHardConfigurations) {
  Spheres overlapping = random_spheres(40, 11, 3, 0.95);
  Spheres nearly = chain(12, 2 + 1e-8);
  for (const Spheres& s : {random_spheres(60, 9.5, 1), random_spheres(60, 60, 2), overlapping, nearly, chain(40),
                           chain(30, 2 * (1 - 9e-3)), chain(30, 1.8), octahedron(), random_spheres(30, 40, 5, 1, 10)}) {
    Eigen::LLT<Eigen::MatrixXd> llt(full(far_field_mobility(s)));
    EXPECT_EQ(llt.info(), Eigen::Success);
  }
}

TEST(FarField, RefusesCoincidentSpheres) {
  EXPECT_THROW(DenseHydrodynamics(unit_spheres({{0, 0, 0}, {5, 0, 0}, {0, 0, 0}}), 1, {}), std::invalid_argument);
  EXPECT_THROW(DenseHydrodynamics(unit_spheres({{0, 0, 0}, {NAN, 0, 0}}), 1, {}), std::invalid_argument);
  EXPECT_THROW(DenseHydrodynamics(unit_spheres({{0, 0, 0}, {1.7, 0, 0}}), 1, {}), std::invalid_argument);
}

TEST(FarField, MobilityInvertsResistance) {
  const Spheres s = random_spheres(20, 8, 7, 1, 2);
  const DenseHydrodynamics hydro(s, 0.7, {});
  const Eigen::VectorXd velocity = Eigen::VectorXd::Random(120);
  const LinearFlow flow = simple_shear(1.3);
  const SphereLoads loads = hydro.resistance(velocity, flow);
  const SphereMotion motion = hydro.mobility(loads.force_torque, flow);
  EXPECT_LT((motion.velocity - velocity).norm(), 1e-10 * velocity.norm());  // condition number ~ 1e2
  EXPECT_LT((motion.stresslet - loads.stresslet).norm(), 1e-10 * loads.stresslet.norm());
}

double tension_of_doublet(const RigidBodyResponse& r) { return r.loads(planar_elongation(1))[6] / (6 * pi); }

TEST(FarField, DoubletHasTheKnownErrorsOfTheMethod) {
  const Spheres s = chain(2);
  const RigidBodyResponse r = rigid_body_response(DenseHydrodynamics(s, 1, {}), s.position, Vector3::Zero());
  EXPECT_NEAR(tension_of_doublet(r), 0.95238, 5e-6);  // exact hydrodynamics: 1.01936
  EXPECT_NEAR(r.drag(0, 0) / (6 * pi) / 1.290283, 1, 6e-3);
  EXPECT_NEAR(r.drag(1, 1) / (6 * pi) / 1.449322, 1, 7e-3);
  EXPECT_LT(r.drag(0, 0) / (6 * pi), 1.290283);  // Galerkin: never above the exact drag
  EXPECT_LT(r.drag(1, 1) / (6 * pi), 1.449322);
}

// Errors in per cent of the drag and of the largest force on one sphere in elongation, without lubrication and with
// that of all pairs as printed. Computed once with independent tables of two spheres: 0.2 % apart.
TEST(FarField, SmallClustersHaveTheKnownErrorsOfTheMethod) {
  struct Case {
    Spheres s;
    double drag, force, lubricated_drag, lubricated_force;
  };
  HydroModel printed{Rung::fts_lubrication};
  printed.lubrication_range = 4;
  const auto response = [](const Spheres& s, const HydroModel& m) {
    return rigid_body_response(DenseHydrodynamics(s, 1, m), s.position, Vector3::Zero());
  };
  const auto drag = [](const RigidBodyResponse& r) { return r.drag.topLeftCorner<3, 3>().trace(); };
  const auto force = [](const RigidBodyResponse& r) {
    const Eigen::VectorXd loads = r.loads(planar_elongation(1));
    double largest = 0;
    for (Eigen::Index i = 0; i < loads.size(); i += 6) largest = std::max(largest, loads.segment<3>(i).norm());
    return largest;
  };
  for (const Case& c : {Case{chain(2), -0.6, -6.6, 0, 0}, Case{tetrahedron(), -0.3, -13, 2.4, -4.6},
                        Case{octahedron(), -0.4, -19, 4.8, -3.5}}) {
    const RigidBodyResponse exact = response(c.s, {Rung::multipole, 8}), far = response(c.s, {}),
                            near = response(c.s, printed);
    EXPECT_NEAR(100 * (drag(far) / drag(exact) - 1), c.drag, 0.1);
    EXPECT_NEAR(100 * (force(far) / force(exact) - 1), c.force, 0.3);
    EXPECT_NEAR(100 * (drag(near) / drag(exact) - 1), c.lubricated_drag, 0.2);
    EXPECT_NEAR(100 * (force(near) / force(exact) - 1), c.lubricated_force, 0.2);
  }
}

}  // namespace
}  // namespace crumble::testing
