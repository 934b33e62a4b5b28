#include "common/agglomerate/import.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "common/agglomerate/extended_xyz.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/contact/jkr.hpp"
#include "tests/agglomerate/shapes.hpp"

namespace crumble {
namespace {

constexpr double a = 10e-9;

ImportOptions of_radius(double radius) {
  ImportOptions options;
  options.radius = radius;
  return options;
}

TEST(Import, NearPairsBecomeContactsAtEquilibrium) {
  const PointList p = parse_csv("x,y,z\n0,0,0\n20.1,0,0\n40.4,0,0\n60.9,0,0\n", "points.csv");
  const Imported r = import_points(p, of_radius(a));
  ASSERT_EQ(r.closed.agglomerate.state.contacts.size(), 1u);  // gaps 0.01 a, 0.03 a, 0.05 a
  EXPECT_NEAR(r.closed.agglomerate.state.contacts[0].gap, Jkr(Material(), a).equilibrium_gap, 1e-12 * a);
  EXPECT_EQ(r.closed.agglomerate.particles.radius, std::vector<double>(4, a));
  EXPECT_NEAR(r.closed.agglomerate.particles.mass[0], 1300 * 4 * std::numbers::pi / 3 * a * a * a, 1e-36);
  EXPECT_EQ(r.closed.agglomerate.particles.id, (std::vector<std::int64_t>{0, 1, 2, 3}));
}

TEST(Import, ToleranceIsAFractionOfTheRadius) {
  const PointList p = parse_csv("x,y,z\n0,0,0\n20.1,0,0\n40.4,0,0\n60.9,0,0\n", "points.csv");
  ImportOptions options = of_radius(a);
  options.contact_tolerance = 0.04;
  EXPECT_EQ(import_points(p, options).closed.agglomerate.state.contacts.size(), 2u);
}

TEST(Import, UnitsScaleTheWholeFile) {
  const PointList micro = parse_csv("x,y,z,radius\n0,0,0,0.1\n0.3,0,0,0.2\n", "points.csv");
  ImportOptions options;
  options.unit = 1e-6;
  const Imported r = import_points(micro, options);
  EXPECT_NEAR(r.closed.agglomerate.particles.radius[1], 2e-7, 1e-20);
  ASSERT_EQ(r.closed.agglomerate.state.contacts.size(), 1u);
  // Unequal spheres meet at the equilibrium of 2 R*, here 4/3 of the smaller radius.
  EXPECT_NEAR(r.closed.agglomerate.state.contacts[0].gap, Jkr(Material(), 4.0 / 3 * 1e-7).equilibrium_gap,
              1e-12 * 1e-7);
}

std::string complaint(const PointList& p, const ImportOptions& options) {
  try {
    import_points(p, options);
  } catch (const PointListError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Import, OverlappingAndDuplicateCentresAreNamedByLine) {
  EXPECT_EQ(complaint(parse_csv("x,y,z\n0,0,0\n50,0,0\n19,0,0\n", "p.csv"), of_radius(a)),
            "p.csv:4: two spheres overlap by 10.0 % of the radius, allowed are 2.9 % of the radius: check --radius, "
            "--unit or --contact-tolerance (the other on line 2)");
  EXPECT_EQ(complaint(parse_csv("x,y,z\n1,2,3\n50,0,0\n1,2,3\n", "p.csv"), of_radius(a)),
            "p.csv:4: two spheres have the same centre (the other on line 2)");
}

TEST(Import, ManyOverlapsAreNotAllListed) {
  std::string text = "x,y,z\n";
  for (int k = 0; k < 30; ++k) text += std::to_string(k) + ",0,0\n";
  const std::string message = complaint(parse_csv(text, "p.csv"), of_radius(a));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 10);
  EXPECT_NE(message.find("p.csv: and more such pairs"), std::string::npos);
}

TEST(Import, RadiusComesFromTheFileOrTheOptionButNotFromBothOrNeither) {
  EXPECT_EQ(complaint(parse_csv("x,y,z\n0,0,0\n", "p.csv"), {}),
            "p.csv: has no column of radii or diameters: give the radius of all spheres (--radius)");
  EXPECT_EQ(complaint(parse_csv("x,y,z,radius\n0,0,0,1\n", "p.csv"), of_radius(a)),
            "p.csv: has radii of its own: leave --radius out");
}

TEST(Import, AForgottenUnitIsNoticed) {
  ImportOptions options;
  options.unit = 1;
  EXPECT_EQ(complaint(parse_csv("x,y,z,radius\n0,0,0,10\n", "p.csv"), options),
            "p.csv:2: a length is larger than 1 m: check --unit");
}

TEST(Import, OneSphereIsAnAgglomerateWithoutContacts) {
  const Imported r = import_points(parse_xyz("1\n\nA 1 2 3\n", "p.xyz"), of_radius(a));
  EXPECT_EQ(r.closed.agglomerate.state.position.size(), 1u);
  EXPECT_TRUE(r.closed.agglomerate.state.contacts.empty());
}

TEST(ExtendedXyz, WhatIsExportedImportsAsTheSameAgglomerate) {
  const PointList first = parse_csv("x,y,z,radius\n0,0,0,10\n25.1,0,0,15\n25,30.1,0,15\n25,30,35,20\n", "p.csv");
  const Imported once = import_points(first, {});
  ASSERT_EQ(once.closed.agglomerate.state.contacts.size(), 3u);
  std::ostringstream text;
  write_extended_xyz(text, once.closed.agglomerate.particles, once.closed.agglomerate.state);
  const Imported twice = import_points(parse_xyz(text.str(), "p.xyz"), {});
  ASSERT_EQ(twice.closed.agglomerate.state.contacts.size(), 3u);
  for (std::size_t i = 0; i < 4; ++i) {
    // Through nm and back, then closed again: both round.
    EXPECT_LT((twice.closed.agglomerate.state.position[i] - once.closed.agglomerate.state.position[i]).norm(),
              1e-13 * a);
    EXPECT_NEAR(twice.closed.agglomerate.particles.radius[i], once.closed.agglomerate.particles.radius[i], 1e-15 * a);
  }
}

TEST(ExtendedXyz, ColumnsStandAsTheHeaderSays) {
  Frame f = shapes::frame({{0, 0, 0}, {2 * a, 0, 0}, {9 * a, 0, 0}}, {{.i = 0, .j = 1}});
  f.time = 1e-4;
  f.step = 12;
  f.velocity.assign(3, Vector3(1, 2, 3));
  f.orientation.assign(3, Quaternion(0.5, 0.1, 0.2, 0.3));
  std::ostringstream text;
  write_extended_xyz(text, shapes::equal_spheres(3, a), f);
  EXPECT_EQ(text.str(),
            "3\nLattice=\"110 0 0 0 20 0 0 0 20\" Origin=\"-10 -10 -10\" pbc=\"F F F\" "
            "Properties=id:I:1:pos:R:3:radius:R:1:velo:R:3:orientation:R:4:cluster:I:1:n_neighb:I:1 Time=0.0001 "
            "Timestep=12\n"
            "0 0 0 0 10 1 2 3 0.1 0.2 0.3 0.5 0 1\n"
            "1 20 0 0 10 1 2 3 0.1 0.2 0.3 0.5 0 1\n"
            "2 90 0 0 10 1 2 3 0.1 0.2 0.3 0.5 1 0\n");
}

TEST(ExtendedXyz, BondsAreADumpLocalFile) {
  Frame f = shapes::frame({{0, 0, 0}, {2 * a, 0, 0}}, {{.i = 0, .j = 1}});
  f.contacts[0].gap = -1e-10;
  f.contacts[0].normal_force = 2e-10;
  f.contacts[0].sliding_force = Vector3(0, 3e-10, 4e-10);
  f.contacts[0].twisting_torque = -1e-19;
  std::ostringstream text;
  write_bonds(text, shapes::equal_spheres(2, a), f);
  EXPECT_EQ(text.str(),
            "ITEM: TIMESTEP\n0\nITEM: NUMBER OF BONDS\n1\nITEM: BOX BOUNDS ff ff ff\n-10 30\n-10 10\n-10 10\n"
            "ITEM: BONDS batom1 batom2 btype dist gap_nm tension_N sliding_force_N twisting_torque_Nm "
            "rolling_torque_Nm\n"
            "0 1 1 20 -0.1 2e-10 5e-10 -1e-19 0\n");
}

}  // namespace
}  // namespace crumble
