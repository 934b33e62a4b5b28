// import and scale: files that check as valid and hold closed contacts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/contact/jkr.hpp"
#include "common/io/agglomerate_reader.hpp"
#include "common/io/sha256.hpp"
#include "tests/tool/run_tool.hpp"

namespace crumble::test {
namespace {

constexpr const char* square = "# four spheres in a square\nx,y,z\n0,0,0\n20.1,0,0\n20,20.05,0\n0.1,20,0\n";

void expect_closed(const Agglomerate& a, const Material& material) {
  for (const Contact& c : a.state.contacts) {
    const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
    const double radius = pair_radius(a.particles.radius[i], a.particles.radius[j]);
    const double gap =
        (a.state.position[j] - a.state.position[i]).norm() - a.particles.radius[i] - a.particles.radius[j];
    // Stored in nm: a few roundings of coordinates of two radii.
    EXPECT_NEAR(gap, Jkr(material, radius).equilibrium_gap, 1e-13 * radius);
    EXPECT_NEAR(c.gap, gap, 1e-13 * radius);
    EXPECT_EQ(c.sliding.norm() + c.rolling.norm() + std::abs(c.twisting), 0);
  }
}

TEST(AgglomerateImport, MakesAValidFileWithClosedContactsAndItsSource) {
  const Folder folder;
  write_text(folder / "square.csv", square);
  const Ran ran = agglomerate(folder, "import square.csv --radius 10 -o square.h5");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("4 spheres, 4 pairs taken as contacts"), std::string::npos) << ran.out;
  EXPECT_EQ(agglomerate(folder, "check square.h5").out, "square.h5: valid\n");
  const Agglomerate a = read_agglomerate(folder / "square.h5");
  EXPECT_EQ(a.state.contacts.size(), 4u);
  expect_closed(a, Material());
  const FileInfo info = read_info(folder / "square.h5");
  EXPECT_EQ(info.stage, "agglomerate");
  EXPECT_EQ(info.provenance.parent, "square.csv");
  EXPECT_EQ(info.provenance.parent_sha256, sha256_of_text(square));
}

TEST(AgglomerateImport, UnitsRadiiAndMaterialCount) {
  const Folder folder;
  write_text(folder / "pair.csv", "radius,x,y,z\n0.1,0,0,0\n0.2,0.3,0,0\n");
  const Ran ran = agglomerate(folder, "import pair.csv --unit um --surface-energy 0.02 --density 2000 -o pair.h5");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Agglomerate a = read_agglomerate(folder / "pair.h5");
  Material material;
  material.surface_energy = 0.02;
  ASSERT_EQ(a.state.contacts.size(), 1u);
  expect_closed(a, material);
  EXPECT_NEAR(a.particles.radius[1], 2e-7, 1e-20);
  EXPECT_NEAR(a.particles.mass[1], 2000 * 4 * M_PI / 3 * 8e-21, 1e-30);
}

TEST(AgglomerateImport, OneSphereAndLooseSpheresAreAgglomeratesToo) {
  const Folder folder;
  write_text(folder / "one.xyz", "1\n\nA 1 2 3\n");
  ASSERT_EQ(agglomerate(folder, "import one.xyz --radius 10 -o one.h5").code, 0);
  write_text(folder / "two.xyz", "2\n\nA 0 0 0\nA 50 0 0\n");
  ASSERT_EQ(agglomerate(folder, "import two.xyz --radius 10 -o two.h5").code, 0);
  EXPECT_EQ(agglomerate(folder, "check one.h5 two.h5").code, 0);
  EXPECT_TRUE(read_agglomerate(folder / "two.h5").state.contacts.empty());
}

TEST(AgglomerateImport, OverlapsAreNamedAndNothingIsWritten) {
  const Folder folder;
  write_text(folder / "p.csv", "x,y,z\n0,0,0\n15,0,0\n");
  const Ran ran = agglomerate(folder, "import p.csv --radius 10 -o p.h5");
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("p.csv:3: two spheres overlap by 50.0 % of the radius"), std::string::npos) << ran.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "p.h5"));
}

TEST(AgglomerateImport, SelfStressAndLostContactsOfAHyperstaticClusterAreTold) {
  const Folder folder;
  // Five in a ring and a cap on either side: 15 contacts fix the shape and leave the caps 0.103 a apart. Taken as a
  // contact, that pair strains all others; JKR contacts of 10 nm hold 0.003 a, so it (or one of the ring) is lost.
  std::string text = "x,y,z\n0,0,10.515\n0,0,-10.515\n";
  for (int k = 0; k < 5; ++k) {
    text += fmt::format("{},{},0\n", 17.013 * std::cos(0.4 * M_PI * k), 17.013 * std::sin(0.4 * M_PI * k));
  }
  write_text(folder / "ring.csv", text);
  const Ran ran = agglomerate(folder, "import ring.csv --radius 10 --contact-tolerance 0.15 -o ring.h5");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("16 pairs taken as contacts"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("contacts lost (open beyond the pull-off gap): 1\n"), std::string::npos) << ran.out;
  EXPECT_EQ(agglomerate(folder, "check ring.h5").code, 0);
  const Agglomerate ring = read_agglomerate(folder / "ring.h5");
  EXPECT_EQ(ring.state.contacts.size(), 15u);
  expect_closed(ring, Material());
}

TEST(AgglomerateScale, KeepsTheContactsClosesThemAndNamesItsParent) {
  const Folder folder;
  write_text(folder / "square.csv", square);
  ASSERT_EQ(agglomerate(folder, "import square.csv --radius 10 -o small.h5").code, 0);
  const Ran ran = agglomerate(folder, "scale small.h5 --radius 100 -o large.h5");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("radius 10 nm -> 100 nm"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("residual self-stress"), std::string::npos);
  EXPECT_EQ(agglomerate(folder, "check large.h5").out, "large.h5: valid\n");
  const Agglomerate small = read_agglomerate(folder / "small.h5"), large = read_agglomerate(folder / "large.h5");
  ASSERT_EQ(large.state.contacts.size(), small.state.contacts.size());
  expect_closed(large, Material());
  EXPECT_NEAR(large.particles.radius[0], 1e-7, 1e-21);
  EXPECT_NEAR(large.particles.mass[0], 1e3 * small.particles.mass[0], 1e-12 * large.particles.mass[0]);
  const FileInfo info = read_info(folder / "large.h5");
  EXPECT_EQ(info.provenance.parent, "small.h5");
  EXPECT_EQ(info.provenance.parent_sha256, sha256_of_file(folder / "small.h5"));
}

TEST(AgglomerateScale, TakesTheLastFrameOfADryingWithoutItsHistories) {
  const Folder folder;
  write_sample(folder / "a.h5");
  const Ran ran = agglomerate(folder, "scale a.h5 --radius 50 -o b.h5");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(agglomerate(folder, "check b.h5").code, 0);
  const Agglomerate b = read_agglomerate(folder / "b.h5");
  EXPECT_EQ(read_info(folder / "b.h5").frames, 1u);
  expect_closed(b, Material());
  EXPECT_EQ(b.particles.id, sample_particles(sample_size).id);
}

}  // namespace
}  // namespace crumble::test
