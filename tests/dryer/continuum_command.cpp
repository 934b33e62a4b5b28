#include "dryer/continuum_command.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/io/errors.hpp"
#include "tests/temporary_folder.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

class ContinuumCommand : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }

  static int run(std::vector<const char*> words) {
    words.insert(words.begin(), "dryer continuum");
    return continuum_command(static_cast<int>(words.size()), words.data());
  }
  static std::string complaint(const std::vector<const char*>& words) {
    try {
      run(words);
    } catch (const InputError& error) {
      return error.what();
    }
    return "(no complaint)";
  }

  const test::Folder folder_;
};

TEST_F(ContinuumCommand, writes_a_row_for_each_radius_and_time) {
  const std::string out = file("out.csv");
  ASSERT_EQ(run({"--peclet", "1", "--theta", "0,0.4", "-o", out.c_str()}), 0);
  std::ifstream in(out);
  std::string line, last;
  int rows = 0;
  std::getline(in, line);
  EXPECT_EQ(line, "theta,rho,gamma");
  for (; std::getline(in, line); ++rows) last = line;
  EXPECT_EQ(rows, 2 * 201);
  double theta = 0, rho = 0, gamma = 0;
  ASSERT_EQ(std::sscanf(last.c_str(), "%lf,%lf,%lf", &theta, &rho, &gamma), 3) << last;
  EXPECT_EQ(theta, 0.4);
  EXPECT_EQ(rho, 1);
  EXPECT_NEAR(gamma, 2.37290, 0.501e-5);
}

TEST_F(ContinuumCommand, says_what_is_wrong_with_its_arguments) {
  const std::string out = file("out.csv"), nowhere = file("nowhere/out.csv");
  const auto has = [](const std::string& text, const char* what) { return text.find(what) != std::string::npos; };
  const auto with = [&](const char* peclet, const char* theta, const std::string& o) {
    return complaint({"--peclet", peclet, "--theta", theta, "-o", o.c_str()});
  };
  EXPECT_PRED2(has, complaint({"--peclet", "1", "-o", out.c_str()}), "--peclet, --theta and -o are all needed");
  EXPECT_PRED2(has, with("one", "0.2", out), "--peclet: 'one' is not a number");
  EXPECT_PRED2(has, with("1", "0.2;0.4", out), "--theta: '0.2;0.4' is not a number");
  EXPECT_PRED2(has, with("1", "0.2,,0.4", out), "--theta: '' is not a number");
  EXPECT_PRED2(has, with("0", "0.2", out), "the Peclet number must be above 0");
  EXPECT_PRED2(has, with("nan", "0.2", out), "the Peclet number must be above 0");
  EXPECT_PRED2(has, with("1", "1", out), "theta must be at least 0 and below 1; it is 1");
  EXPECT_PRED2(has, with("1", "0.4,0.2", out), "theta must increase; 0.2 stands behind 0.4");
  EXPECT_PRED2(has, with("1", "0.2", nowhere), "there is no folder");
  EXPECT_PRED2(has, with("1", "0.2", folder_.path().string()), "this is a folder");
  EXPECT_PRED2(has, complaint({"--pecle", "1"}), "--pecle");
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
