#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/io/report.hpp"
#include "tests/temporary_folder.hpp"

using namespace crumble;

namespace {

Report filled() {
  Report report("dryer", "0.1.0", "hollow.toml", 3);
  report.steps = 1234;
  report.result("contacts", std::int64_t{173});
  report.result("d_c_nm", 160.1 + 1e-13);
  report.result("law", std::string("jkr"));
  report.result("semi_axes_nm", std::vector<double>{80.5, 79, 78.25});
  report.result("shear.n_max", 3.25);
  report.result("shear.contact", std::vector<std::int64_t>{4, 7});
  report.result("shear.critical_stress_pa", nullptr);
  report.error("d_c_relative", 1.5e-3, "step halving");
  report.error("contacts_relative", {}, "not estimated: paths diverge");
  report.left_out.push_back("Brownian motion: D = 0");
  return report;
}

}  // namespace

TEST(Report, holds_what_every_program_reports) {
  const auto json = nlohmann::json::parse(filled().json());
  EXPECT_EQ(json.at("program"), "dryer");
  EXPECT_EQ(json.at("version"), "0.1.0");
  EXPECT_EQ(json.at("scene"), "hollow.toml");
  EXPECT_EQ(json.at("seed"), 3);
  EXPECT_EQ(json.at("steps"), 1234);
  EXPECT_EQ(json.at("results").at("contacts"), 173);
  EXPECT_EQ(json.at("results").at("d_c_nm").get<double>(), 160.1 + 1e-13);  // all digits
  EXPECT_EQ(json.at("results").at("semi_axes_nm").at(2), 78.25);
  EXPECT_EQ(json.at("results").at("shear").at("n_max"), 3.25);
  EXPECT_EQ(json.at("results").at("shear").at("contact").at(1), 7);
  EXPECT_TRUE(json.at("results").at("shear").at("critical_stress_pa").is_null());
  EXPECT_EQ(json.at("errors").at("d_c_relative").at("value"), 1.5e-3);
  EXPECT_EQ(json.at("errors").at("d_c_relative").at("how"), "step halving");
  EXPECT_TRUE(json.at("errors").at("contacts_relative").at("value").is_null());
  EXPECT_EQ(json.at("left_out").at(0), "Brownian motion: D = 0");
}

TEST(Report, measures_wall_time_processor_time_and_peak_memory) {
  const Report report("dryer", "", "", {});
  double work = 0;
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(50)) work += std::sqrt(work + 1);
  const auto json = nlohmann::json::parse(report.json());
  EXPECT_GE(json.at("wall_s").get<double>(), 0.05) << work;
  EXPECT_GT(json.at("cpu_s").get<double>(), 0.0);
  // A process of ours cannot be below 1 MB, and this one not above 1 GB (10 GB with the address sanitizer).
  EXPECT_GT(json.at("peak_rss_bytes").get<std::int64_t>(), 1000 * 1000);
  EXPECT_LT(json.at("peak_rss_bytes").get<std::int64_t>(), 10'000'000'000);
  EXPECT_TRUE(json.at("seed").is_null());
}

TEST(Report, refuses_what_is_not_finite) {
  Report report = filled();
  EXPECT_THROW(report.result("d_c_nm", std::nan("")), std::runtime_error);
  EXPECT_THROW(report.result("axes", std::vector<double>{1, std::numeric_limits<double>::infinity()}),
               std::runtime_error);
  EXPECT_THROW(report.error("d_c", std::nan(""), "x"), std::runtime_error);
}

TEST(Report, is_written_whole_or_not_at_all) {
  const test::Folder folder;
  const std::string file = folder.file("r.json");
  filled().write(file);
  std::ifstream in(file);
  EXPECT_EQ(nlohmann::json::parse(in).at("steps"), 1234);
  EXPECT_FALSE(std::filesystem::exists(file + ".tmp"));
  std::filesystem::remove_all(folder.path());
  EXPECT_THROW(filled().write(file), std::runtime_error);
}
