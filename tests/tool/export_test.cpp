// export: other programs' files hold what ours does.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "common/agglomerate/fragments.hpp"
#include "common/io/agglomerate_reader.hpp"
#include "tests/tool/run_tool.hpp"

namespace crumble::test {
namespace {

nlohmann::json read_by_vtk(const Folder& folder, const std::string& file) {
  const Ran ran = run_in(folder, "/usr/bin/python3 '" CRUMBLE_SOURCE_DIR "/tests/tool/read_vtkhdf.py' " + file);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return nlohmann::json::parse(ran.out, nullptr, false);
}

void expect_vtk_holds(const nlohmann::json& grid, const Particles& particles, const Frame& frame) {
  const std::size_t n = particles.size();
  ASSERT_EQ(grid["points"].size(), 3 * n);
  ASSERT_EQ(grid["cells"].size(), n + frame.contacts.size());
  const auto& points = grid["point_data"];
  const auto label = fragments(n, frame.contacts);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(grid["types"][i], 1);
    EXPECT_EQ(grid["cells"][i], nlohmann::json::array({i}));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto d = static_cast<Eigen::Index>(k);
      EXPECT_DOUBLE_EQ(grid["points"][3 * i + k], 1e9 * frame.position[i][d]);
      EXPECT_EQ(points["velocity"][3 * i + k], frame.velocity[i][d]);
    }
    EXPECT_EQ(points["id"][i], particles.id[i]);
    EXPECT_DOUBLE_EQ(points["radius"][i], 1e9 * particles.radius[i]);
    EXPECT_EQ(points["fragment"][i], label[i]);
    EXPECT_EQ(points["orientation"][4 * i], frame.orientation[i].w());
  }
  for (std::size_t m = 0; m < frame.contacts.size(); ++m) {
    const Contact& c = frame.contacts[m];
    EXPECT_EQ(grid["types"][n + m], 3);
    EXPECT_EQ(grid["cells"][n + m], nlohmann::json::array({c.i, c.j}));
    EXPECT_EQ(grid["cell_data"]["normal_force"][n + m], c.normal_force);
    EXPECT_EQ(grid["cell_data"]["sliding_force"][3 * (n + m) + 1], c.sliding_force.y());
    EXPECT_EQ(grid["cell_data"]["contact"][n + m], 1);
  }
  EXPECT_TRUE(grid["cell_data"]["normal_force"][0].is_null());  // not a number on a vertex
}

TEST(AgglomerateExport, VtkReadsTheLastFrame) {
  const Folder folder;
  write_sample(folder / "a.h5");
  ASSERT_EQ(agglomerate(folder, "export a.h5 -o a.hdf --frame last").code, 0);
  const AgglomerateReader reader(folder / "a.h5");
  expect_vtk_holds(read_by_vtk(folder, "a.hdf"), reader.particles(), reader.last_frame());
}

TEST(AgglomerateExport, AllFramesBecomeASeriesWithTheirTimes) {
  const Folder folder;
  write_sample(folder / "a.h5");
  ASSERT_EQ(agglomerate(folder, "export a.h5 -o a.hdf").code, 0);
  const AgglomerateReader reader(folder / "a.h5");
  const auto series = nlohmann::json::parse(text_of(folder / "a.hdf.series"));
  EXPECT_EQ(series["file-series-version"], "1.0");
  ASSERT_EQ(series["files"].size(), static_cast<std::size_t>(sample_frames));
  for (std::size_t t = 0; t < sample_frames; ++t) {
    EXPECT_EQ(series["files"][t]["time"], reader.frame(t).time);
    const std::string name = series["files"][t]["name"];
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
  expect_vtk_holds(read_by_vtk(folder, series["files"][1]["name"]), reader.particles(), reader.frame(1));
}

TEST(AgglomerateExport, XyzHoldsAllFramesAndTheBondsOfEach) {
  const Folder folder;
  write_sample(folder / "a.h5");
  ASSERT_EQ(agglomerate(folder, "export a.h5 -o a.xyz").code, 0);
  const std::string xyz = text_of(folder / "a.xyz"), bonds = text_of(folder / "a.bonds.dump");
  const auto count = [](const std::string& text, const std::string& word) {
    int found = 0;
    for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count(xyz, "Properties=id:I:1:pos:R:3:radius:R:1:velo:R:3:orientation:R:4:cluster:I:1:n_neighb:I:1"),
            sample_frames);
  EXPECT_EQ(count(xyz, "\n"), sample_frames * (static_cast<int>(sample_size) + 2));
  EXPECT_EQ(count(bonds, "ITEM: BONDS batom1 batom2"), sample_frames);
  const AgglomerateReader reader(folder / "a.h5");
  int contacts = 0;
  for (std::size_t t = 0; t < sample_frames; ++t) contacts += static_cast<int>(reader.frame(t).contacts.size());
  EXPECT_EQ(count(bonds, "\n"), contacts + 9 * sample_frames);
  // Bonds name particles by id, which begin at 100 in the sample.
  EXPECT_NE(bonds.find("\n100 101 1 "), std::string::npos);
}

TEST(AgglomerateExport, WhatIsImportedExportedAndImportedAgainIsTheSame) {
  const Folder folder;
  write_text(folder / "p.csv", "x,y,z,radius\n0,0,0,10\n25.1,0,0,15\n25,30.1,0,15\n25,30,35,20\n");
  ASSERT_EQ(agglomerate(folder, "import p.csv -o one.h5").code, 0);
  ASSERT_EQ(agglomerate(folder, "export one.h5 -o one.xyz").code, 0);
  ASSERT_EQ(agglomerate(folder, "import one.xyz -o two.h5").code, 0);
  const Agglomerate one = read_agglomerate(folder / "one.h5"), two = read_agglomerate(folder / "two.h5");
  ASSERT_EQ(one.state.contacts.size(), 3u);
  ASSERT_EQ(two.state.contacts.size(), 3u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((one.state.position[i] - two.state.position[i]).norm(), 1e-20);  // 1e-12 of a radius
    EXPECT_NEAR(one.particles.radius[i], two.particles.radius[i], 1e-22);
  }
}

TEST(AgglomerateExport, NothingIsLeftWhereTheResultCannotBeWritten) {
  const Folder folder;
  write_sample(folder / "a.h5");
  std::filesystem::create_directory(folder / "a.bonds.dump.tmp");  // stands where the bonds would go
  const Ran ran = agglomerate(folder, "export a.h5 -o a.xyz");
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("'a.bonds.dump.tmp' is used for writing it, and is there already but not a file"),
            std::string::npos)
      << ran.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "a.xyz"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.xyz.tmp"));
}

}  // namespace
}  // namespace crumble::test
