// Pair lubrication on top of the far field: exact for two spheres, harmless for rigid bodies only if relative.
#include "common/hydro/lubrication.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>
#include <tuple>

#include "clusters.hpp"
#include "common/hydro/dense_hydrodynamics.hpp"
#include "common/hydro/far_field.hpp"
#include "common/hydro/rigid_body.hpp"
#include "elastic_network.hpp"

namespace crumble::testing {
namespace {

using std::numbers::pi;

HydroModel model(Rung rung, double range = 2.5) {
  HydroModel m;
  m.rung = rung;
  m.lubrication_range = range;
  return m;
}

RigidBodyResponse response(const Spheres& s, const HydroModel& m) {
  return rigid_body_response(DenseHydrodynamics(s, 1, m), s.position, Vector3::Zero());
}

const Vector3 some_direction = Vector3(0.4, -0.5, 0.7).normalized();

TEST(Lubrication, PairIsExactTwoSpheresMinusFarField) {
  for (const double distance : {2 + 1e-6, 2.01, 2.5, 4.0}) {
    const Vector3 r = distance * some_direction;
    const PairMatrix expected = two_sphere_pair(r, 1, 1) - Eigen::MatrixXd(far_field_pair(r, 1, 1)).inverse();
    const PairMatrix found = pair_lubrication(r, 1, 1, PairMotion::all);
    EXPECT_LT((found - expected).norm(), 1e-10 * two_sphere_pair(r, 1, 1).norm()) << distance;
  }
}

// The far field is a Galerkin lower bound of the exact resistance.
TEST(Lubrication, IsPositiveSemiDefinite) {
  for (const double distance : {1.9, 2.0, 2 + 1e-8, 2.001, 2.1, 2.5, 3.0, 4.0, 6.0})
    for (const PairMotion motion : {PairMotion::all, PairMotion::relative}) {
      const Eigen::MatrixXd D = pair_lubrication(distance * some_direction, 1, 1, motion);
      const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(D).eigenvalues();
      EXPECT_GT(eigenvalues.minCoeff(), -1e-9 * std::max(1.0, eigenvalues.maxCoeff() * 1e-3)) << distance;
    }
}

Eigen::Matrix<double, 22, 6> rigid_motions(const Vector3& r) {
  Eigen::Matrix<double, 22, 6> Z = Eigen::Matrix<double, 22, 6>::Zero();
  for (int s = 0; s < 2; ++s) {
    const Vector3 x = s == 0 ? Vector3(-r / 2) : Vector3(r / 2);
    Z.block<6, 6>(11 * s, 0).setIdentity();
    Z.block<3, 3>(11 * s, 3) << 0, x.z(), -x.y(), -x.z(), 0, x.x(), x.y(), -x.x(), 0;
  }
  return Z;
}

TEST(Lubrication, RelativeFormExertsNothingInRigidMotionOfThePair) {
  for (const double distance : {1.9, 1.998, 2 + 1e-8, 2.05, 3.0}) {
    const Vector3 r = distance * some_direction;
    const PairMatrix D = pair_lubrication(r, 1, 1, PairMotion::relative);
    // Round-off: terms of order 1/gap, up to 1e6 at the floor, cancel in the matrices that D is the difference of.
    EXPECT_LT((D * rigid_motions(r)).norm(), 1e-14 * (1 + D.norm())) << distance;
  }
}

// The definition, in full matrices and any direction.
TEST(Lubrication, RelativeFormIsWhatAFreePairResistsBeyondItsFarField) {
  for (const double a_2 : {1.0, 0.4}) {
    const Vector3 r = (1 + a_2) * 1.02 * some_direction;
    const Eigen::MatrixXd Z = rigid_motions(r), far = far_field_pair(r, 1, a_2).inverse(),
                          exact = far + pair_lubrication(r, 1, a_2, PairMotion::all);
    const auto free_as_a_whole = [&](const Eigen::MatrixXd& R) {
      return Eigen::MatrixXd(R - R * Z * (Z.transpose() * R * Z).inverse() * Z.transpose() * R);
    };
    const Eigen::MatrixXd expected = free_as_a_whole(exact) - free_as_a_whole(far);
    const PairMatrix D = pair_lubrication(r, 1, a_2, PairMotion::relative);
    EXPECT_LT((D - expected).norm(), 1e-12 * exact.norm()) << a_2;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<PairMatrix>(D).eigenvalues()[0], -1e-12 * exact.norm()) << a_2;
  }
}

// Pairs at the floor share their blocks: same radii, both orders of radii, overlaps of different depth.
TEST(Lubrication, OfAClusterIsThatOfItsPairs) {
  Spheres s = unit_spheres({{0, 0, 0}, {2, 0, 0}, {2, 1.999, 0}, {0, 1.9999, 0}, {0, 0, 2.5}, {3, 1, 2.2}});
  s.radius[4] = s.radius[5] = 1.5;
  for (const PairMotion motion : {PairMotion::all, PairMotion::relative}) {
    const Lubrication sum(s, 2.5, motion);
    EXPECT_EQ(sum.pairs().size(), 8u);
    for (const LubricationPair& p : sum.pairs()) {
      const PairMatrix alone =
          pair_lubrication(s.position[p.j] - s.position[p.i], s.radius[p.i], s.radius[p.j], motion);
      EXPECT_LT((p.resistance - alone).norm(), 1e-12 * alone.norm()) << p.i << " " << p.j;
    }
  }
}

// A pair at the floor feels the same forces in ambient strain whether it just touches or overlaps a little.
TEST(Lubrication, IsContinuousThroughContactAndFiniteInStrain) {
  for (const PairMotion motion : {PairMotion::all, PairMotion::relative}) {
    const auto in_strain = [&](double distance) {
      const Vector3 r = distance * some_direction;
      const PairMatrix D = pair_lubrication(r, 1, 1, motion);
      Eigen::Matrix<double, 22, 1> w;
      const Vector5 e = Vector5::LinSpaced(5, -1, 2);
      const Vector3 shift = 0.5 * (strain_tensor(e) * r);
      w << shift, Vector3::Zero(), -e, -shift, Vector3::Zero(), -e;
      return Eigen::Matrix<double, 22, 1>(D * w);
    };
    const auto touching = in_strain(2 + 1e-6);
    EXPECT_LT((in_strain(2) - touching).norm(), 1e-4 * touching.norm());  // ln 1e-6 terms differ by 1e-6 ln
    EXPECT_LT((in_strain(1.998) - touching).norm(), 1e-2 * touching.norm());
    EXPECT_LT((in_strain(2 + 1e-4) - touching).norm(), 1e-1 * touching.norm());
  }
}

TEST(Lubrication, DoubletInAFlowIsExactInBothForms) {
  const Spheres s = chain(2);
  for (const Rung rung : {Rung::fts_lubrication, Rung::fts_relative_lubrication}) {
    const double tension = response(s, model(rung)).loads(planar_elongation(1))[6] / (6 * pi);
    EXPECT_NEAR(tension, 1.01936, 1e-5);
  }
  const RigidBodyResponse printed = response(s, model(Rung::fts_lubrication));
  EXPECT_NEAR(printed.drag(0, 0) / (6 * pi), 1.290283, 2e-6);
  EXPECT_NEAR(printed.drag(1, 1) / (6 * pi), 1.449322, 2e-6);
}

// Two spheres in touch with radii 1 and q, free in planar elongation along their axis: tension over 6 pi mu gamma_dot
// a^2, a the mean radius, from a series of Lamb's solutions about both centres (80 terms a sphere; error 1e-5 at q = 3,
// 3e-4 at 9).
TEST(Lubrication, DoubletOfUnequalSpheresInAFlowIsExactInTheRelativeForm) {
  for (const auto& [q, tension, error] : {std::tuple{3.0, 0.3815, 1e-4}, {9.0, 0.0377, 3e-4}}) {
    Spheres s;
    s.position = {Vector3::Zero(), Vector3((1 + q) * (1 + 1e-9), 0, 0)};
    s.radius = {1, q};
    const double a = (1 + q) / 2;
    EXPECT_NEAR(response(s, model(Rung::fts_relative_lubrication)).loads(planar_elongation(1))[6] / (6 * pi * a * a),
                tension, error);
    // In the far field alone it is not.
    EXPECT_GT(std::abs(response(s, model(Rung::fts)).loads(planar_elongation(1))[6] / (6 * pi * a * a) - tension),
              10 * error);
  }
}

// Contact deformation of 2e-3 a moves the tension by its own order, not by the 12 % of a mismatched floor.
TEST(Lubrication, OverlappingDoubletKeepsItsTension) {
  const double tension =
      response(chain(2, 2 - 1.88e-3), model(Rung::fts_relative_lubrication)).loads(planar_elongation(1))[6] / (6 * pi);
  EXPECT_NEAR(tension, 1.01936, 3e-3);
}

TEST(Lubrication, RelativeFormKeepsTheDragOfARigidCluster) {
  for (const Spheres& s : {triangle(), octahedron(), compact_85()}) {
    const Eigen::MatrixXd far = response(s, model(Rung::fts)).drag;
    EXPECT_LT((response(s, model(Rung::fts_relative_lubrication, 4)).drag - far).norm(), 1e-8 * far.norm());
  }
}

TEST(Lubrication, PrintedFormDragsACompactClusterMoreThanItsEnclosingSphere) {
  const Spheres s = compact_85();
  Vector3 centre = Vector3::Zero();
  for (const Vector3& x : s.position) centre += x / s.size();
  double enclosing = 0;
  for (const Vector3& x : s.position) enclosing = std::max(enclosing, (x - centre).norm() + 1);
  const auto mean_drag = [&](Rung rung, double range) {
    return response(s, model(rung, range)).drag.topLeftCorner<3, 3>().trace() / (18 * pi);
  };
  EXPECT_LT(mean_drag(Rung::fts, 0), enclosing);
  EXPECT_LT(mean_drag(Rung::fts_relative_lubrication, 4), enclosing);
  EXPECT_LT(mean_drag(Rung::multipole, 0), enclosing);
  EXPECT_GT(mean_drag(Rung::fts_lubrication, 4), enclosing);  // the known failure, asserted as known
  // An enclosed sphere: the largest drag of any part of the cluster is a lower bound as well.
  const double doublet = response(chain(2), model(Rung::fts)).drag.topLeftCorner<3, 3>().trace() / (18 * pi);
  for (const Rung rung : {Rung::fts, Rung::fts_relative_lubrication, Rung::multipole})
    EXPECT_GT(mean_drag(rung, 2.5), doublet);
}

// The compact granule of data/compact.h5 (85 spheres, coordination 5.7).
TEST(Lubrication, PrintedFormDragsADriedGranuleHalfAsMuchAgain) {
  const Spheres s = dried_cluster("granule_85").spheres;
  Vector3 centre = Vector3::Zero();
  for (const Vector3& x : s.position) centre += x / s.size();
  double enclosing = 0;
  for (const Vector3& x : s.position) enclosing = std::max(enclosing, (x - centre).norm() + 1);
  const auto drag = [&](const HydroModel& m) { return response(s, m).drag.topLeftCorner<3, 3>().trace() / (18 * pi); };
  const double far = drag(model(Rung::fts)), printed = drag(model(Rung::fts_lubrication));
  EXPECT_LT(far, enclosing);
  EXPECT_LT(std::abs(drag(model(Rung::fts_relative_lubrication)) / far - 1), 1e-8);
  EXPECT_GT(printed, enclosing);   // the known failure, asserted as known
  EXPECT_GT(printed, 1.46 * far);  // 1.46 to 1.70 by density, by an independent code
}

// Largest bond tension of dried clusters in elongation, in three fixed orientations and in the worst one, against
// multipoles of order 3 (1 % from order 4 here). The far field alone is off by up to 5 %, of the granule by 12 %; the
// printed sum by up to 15 %.
TEST(Lubrication, RelativeFormGivesTheBondTensionOfDriedClustersWithinThreePercent) {
  struct Case {
    const char* name;
    double any_orientation;  // bound of the error in the fixed ones
    bool printed_fails;      // in tension; of the densest cluster it is the drag that fails (above)
  };
  for (const auto& [name, any_orientation, printed_fails] :
       {Case{"compact_85", 0.03, true}, Case{"granule_85", 0.08, false}, Case{"hollow_115", 0.03, true}}) {
    const DriedCluster c = dried_cluster(name);
    const auto tensions = [&](const HydroModel& m) {
      const Eigen::MatrixXd T = bond_tension(c.spheres, c.bonds, response(c.spheres, m).free_loads);
      Eigen::Vector4d result;
      for (int k = 0; k < 3; ++k) {
        Eigen::Matrix3d E = Eigen::Matrix3d::Zero();
        E(k, k) = 0.5, E((k + 1) % 3, (k + 1) % 3) = -0.5;
        result[k] = (T * strain_components(E)).maxCoeff();
      }
      result[3] = worst_orientation(T);
      return result;
    };
    const Eigen::Vector4d exact = tensions(model(Rung::multipole));
    const auto error = [&](Rung rung, double range) {
      return Eigen::Array4d((tensions(model(rung, range)).array() / exact.array() - 1).abs());
    };
    const Eigen::Array4d relative = error(Rung::fts_relative_lubrication, HydroModel{}.lubrication_range);
    EXPECT_LT(relative[3], 0.03) << name;
    EXPECT_LT(relative.maxCoeff(), any_orientation) << name;
    if (printed_fails) {
      EXPECT_GT(error(Rung::fts_lubrication, 4).maxCoeff(), 0.10) << name;
    }
  }
}

TEST(Lubrication, MobilityInvertsResistanceDownToTinyGaps) {
  Spheres s = chain(5, 2 + 1e-8);
  s.position[2] += Vector3(0, 1e-3, 0);
  for (const Rung rung : {Rung::fts_lubrication, Rung::fts_relative_lubrication}) {
    const DenseHydrodynamics hydro(s, 1, model(rung));
    Eigen::VectorXd loads(30);
    for (int k = 0; k < 30; ++k) loads[k] = std::sin(1.0 + k);
    const LinearFlow flow = simple_shear(1);
    const SphereMotion motion = hydro.mobility(loads, flow);
    const SphereLoads back = hydro.resistance(motion.velocity, flow);
    EXPECT_LT((back.force_torque - loads).norm(), 1e-7 * loads.norm());  // resistance up to 1e6 at the gap floor
    EXPECT_LT((back.stresslet - motion.stresslet).norm(), 1e-7 * motion.stresslet.norm());
  }
}

}  // namespace
}  // namespace crumble::testing
