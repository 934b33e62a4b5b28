// info and morphology: the same numbers as the library, in every form.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "common/agglomerate/morphology.hpp"
#include "common/io/agglomerate_reader.hpp"
#include "tests/tool/run_tool.hpp"

namespace crumble::test {
namespace {

TEST(AgglomerateInfo, JsonHoldsWhatTheFileSaysOfItself) {
  const Folder folder;
  write_sample(folder / "a.h5");
  const FileInfo info = read_info(folder / "a.h5");
  const auto json = nlohmann::json::parse(agglomerate(folder, "info a.h5 --json").out);
  EXPECT_EQ(json["stage"], info.stage);
  EXPECT_EQ(json["particles"], info.particles);
  EXPECT_EQ(json["frames"], info.frames);
  EXPECT_EQ(json["contacts"], info.contacts);
  EXPECT_EQ(json["last_step"], info.last_step);
  EXPECT_EQ(json["last_time_s"], info.last_time);
  EXPECT_EQ(json["provenance"]["seed"], info.provenance.seed);
  EXPECT_EQ(json["provenance"]["command"], info.provenance.command);
}

TEST(AgglomerateInfo, TextIsForPeople) {
  const Folder folder;
  write_sample(folder / "a.h5");
  const Ran ran = agglomerate(folder, "info a.h5");
  EXPECT_EQ(ran.code, 0);
  EXPECT_NE(ran.out.find("stage      dryer, drying\n"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("dryer 'a scene.toml' -o out.h5"), std::string::npos) << ran.out;
}

TEST(AgglomerateMorphology, JsonCsvAndTableAgreeWithTheLibrary) {
  const Folder folder;
  write_sample(folder / "a.h5");
  const AgglomerateReader reader(folder / "a.h5");
  const Morphology m = morphology(reader.particles(), reader.last_frame());

  const auto json = nlohmann::json::parse(agglomerate(folder, "morphology a.h5 --json").out);
  ASSERT_EQ(json["frames"].size(), 1u);
  const auto& frame = json["frames"][0];
  EXPECT_DOUBLE_EQ(frame["d_c_nm"], 1e9 * m.extent.diameter());
  EXPECT_DOUBLE_EQ(frame["h_c_over_d_c"], m.extent.relative_crust());
  EXPECT_DOUBLE_EQ(frame["radius_of_gyration_nm"], 1e9 * m.radius_of_gyration);
  EXPECT_DOUBLE_EQ(frame["semi_axis_1_nm"], 1e9 * m.semi_axes[0]);
  EXPECT_EQ(frame["contacts"].get<std::int64_t>(), m.contacts);
  EXPECT_TRUE(frame["contacts"].is_number_integer());
  EXPECT_EQ(frame["fragments"].get<std::int64_t>(), m.fragments);
  EXPECT_EQ(frame["radial_positions_nm"].size(), sample_size);

  std::istringstream csv(agglomerate(folder, "morphology a.h5 --csv --frame all").out);
  std::string header, row, last;
  std::getline(csv, header);
  EXPECT_EQ(header.find("step,time_s,particles,d_c_nm,h_c_nm,h_c_over_d_c,"), 0u);
  int rows = 0;
  for (; std::getline(csv, row); ++rows) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
    last = row;
  }
  EXPECT_EQ(rows, sample_frames);
  EXPECT_EQ(last.find(std::to_string(reader.last_frame().step) + ","), 0u);

  EXPECT_NE(agglomerate(folder, "morphology a.h5").out.find("d_c_nm"), std::string::npos);
}

TEST(AgglomerateMorphology, DistributionRisesToOne) {
  const Folder folder;
  write_sample(folder / "a.h5");
  std::istringstream csv(agglomerate(folder, "morphology a.h5 --cdf --frame 0").out);
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "radial_position_nm,fraction");
  double r = 0, fraction = 0, before = 0;
  char comma;
  std::size_t rows = 0;
  for (; csv >> r >> comma >> fraction; ++rows) {
    EXPECT_GE(r, before);
    before = r;
  }
  EXPECT_EQ(rows, sample_size);
  EXPECT_EQ(fraction, 1);
}

}  // namespace
}  // namespace crumble::test
