// What is expected of a scene, and what a granule is.
#include "dryer/outcome.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "dryer/stand_in.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

std::vector<Row> stored_map() {
  std::ifstream file(std::filesystem::path(CRUMBLE_SOURCE_DIR) / "pipeline/verify/regime.csv");
  std::string line;
  std::getline(file, line);
  const auto names = cells(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const auto values = cells(line);
    Row& row = rows.emplace_back();
    for (std::size_t k = 0; k < values.size(); ++k) row[names[k]] = values[k];
  }
  return rows;
}

double number(const std::string& text) {
  return text == "inf" ? std::numeric_limits<double>::infinity() : std::stod(text);
}

}  // namespace

// The shapes of the map that was measured (pipeline/verify/regime_map.py, N = 115): where its granules are clearly one
// or the other, that is what is expected.
TEST(DryingOutcome, agrees_with_the_map_that_was_measured) {
  const auto rows = stored_map();
  ASSERT_GT(rows.size(), 20u);
  int clear = 0, shapes = 0;
  std::map<Shape, int> seen;
  for (const Row& row : rows) {
    DryingRegime r;
    r.peclet = number(row.at("peclet"));
    r.force_ratio = number(row.at("force_ratio"));
    r.capillary_speed = 1;
    r.packed_front_speed = number(row.at("packed_front_over_capillary_speed"));
    const double d_c = number(row.at("d_c_nm")), crust = number(row.at("h_c_over_d_c"));
    Morphology m;
    m.particles = 115;
    m.fragments = std::llround(number(row.at("fragments")));
    m.extent = {0.5e-9 * d_c, 1e-9 * d_c * (0.5 - crust)};
    const Shape found = found_shape(m, 10e-9);
    // Between the two: one or the other by little.
    if (found == Shape::thick_crust || expected_shape(r).shape == Shape::thick_crust) continue;
    ++clear;
    shapes += ++seen[found] == 1;
    EXPECT_EQ(name_of(expected_shape(r).shape), std::string(name_of(found)))
        << "Pe = " << r.peclet << ", force ratio " << r.force_ratio << ", packed front " << r.packed_front_speed;
  }
  EXPECT_GT(clear, 20);
  EXPECT_EQ(shapes, 3);
}

TEST(DryingOutcome, the_cavity_of_a_solid_ball_and_of_a_shell) {
  // Centres uniform in a ball of radius 1: the means of the nearest and the farthest tenth.
  const double near = 0.75 * std::cbrt(0.1), far = 7.5 * (1 - std::pow(0.9, 4.0 / 3));
  EXPECT_NEAR(cavity({far + 0.01, near - 0.01}, 0.01), std::pow(0.1, 4.0 / 3) / (1 - std::pow(0.9, 4.0 / 3)), 1e-12);
  EXPECT_EQ(cavity({1.01, 0.99}, 0.01), 1);
}

TEST(DryingOutcome, a_droplet_that_stands_for_itself_says_nothing_of_others) {
  DryingScene scene;
  scene.radius.assign(1000, 1e-7);
  Morphology m;
  m.extent = {1e-6, 5e-7};
  m.porosity = 0.8;
  m.coordination = 3.5;
  EXPECT_EQ(real_granule_text(scene, m), "");
  // Eight times the particles: twice the size, and a little more.
  scene.stands_for = 8000;
  const RealGranule real = real_granule(scene, m);
  EXPECT_NEAR(real.d_c[0], 4e-6, 1e-18);
  EXPECT_GT(real.d_c[1], 4e-6);
  EXPECT_LT(real.d_c[1], 4.2e-6);
  EXPECT_NEAR(real.porosity[0], 0.8, 1e-12);
  EXPECT_GT(real.porosity[1], 0.8);
  EXPECT_NE(real_granule_text(scene, m).find("from 30 to 100,000 particles"), std::string::npos);
}

// dryer/README.md, measured: 1000, 10,000 and 100,000 particles of 150 nm; d_c in um and coordination.
TEST(DryingOutcome, a_real_granule_is_no_denser_than_spheres_pack_at_random) {
  DryingScene scene;
  scene.radius.assign(60, 1e-8);
  scene.model.thermal_energy = 4e-21;
  scene.stands_for = 4.69e8;
  Morphology m;
  m.extent = {6.4e-8, 0};
  m.porosity = 0.77;
  EXPECT_NEAR(real_granule(scene, m).porosity[0], 0.36, 1e-12);
  EXPECT_NEAR(real_granule(scene, m).porosity[1], 0.77, 1e-12);
  m.porosity = 0.3;  // denser already: as it is
  EXPECT_NEAR(real_granule(scene, m).porosity[0], 0.3, 1e-12);
}

TEST(DryingOutcome, what_is_said_of_large_granules_holds_for_those_that_were_dried) {
  const struct {
    double number, d_c, coordination;
  } dried[] = {{1000, 5.419, 3.558}, {10000, 11.886, 3.620}, {100000, 26.201, 3.621}};
  for (int from = 0; from < 3; ++from)
    for (int to = from + 1; to < 3; ++to) {
      DryingScene scene;
      scene.radius.assign(static_cast<std::size_t>(dried[from].number), 1.5e-7);
      scene.stands_for = dried[to].number;
      Morphology m;
      m.extent = {0.5e-6 * dried[from].d_c, 0};
      m.coordination = dried[from].coordination;
      m.porosity = 0.83;
      const RealGranule real = real_granule(scene, m);
      EXPECT_GE(1e-6 * dried[to].d_c, 0.99 * real.d_c[0]);  // one granule each: seeds scatter by a hundredth
      EXPECT_LE(1e-6 * dried[to].d_c, 1.01 * real.d_c[1]);
      EXPECT_GE(dried[to].coordination, 0.99 * real.coordination[0]);
      EXPECT_LE(dried[to].coordination, 1.01 * real.coordination[1]);
    }
}
