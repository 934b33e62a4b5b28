#include <gtest/gtest.h>

#include <stdexcept>

#include "dryer/water_surface_tension.hpp"
#include "dryer/water_viscosity.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

constexpr double ice_point = 273.15;  // K

struct Tabulated {
  double celsius, value;
};

TEST(WaterViscosity, agrees_with_tables) {
  // mPa s, IAPWS 2008 at 0.1 MPa as tabulated in the CRC Handbook; rounded to the last digit, the simplified
  // correlation is within 0.05 %.
  for (const auto& [celsius, value] : {Tabulated{10, 1.3059}, {20, 1.0016}, {25, 0.8900}, {50, 0.5465}, {80, 0.3540}})
    EXPECT_NEAR(water_viscosity(ice_point + celsius) * 1e3, value, 5e-4 * value) << celsius;
}

TEST(WaterViscosity, falls_with_temperature_over_its_whole_range_and_ends_there) {
  for (double T = water_viscosity_from; T + 1 <= water_viscosity_to; T += 1)
    EXPECT_GT(water_viscosity(T), water_viscosity(T + 1)) << T;
  EXPECT_THROW(water_viscosity(253), std::domain_error);
  EXPECT_THROW(water_viscosity(384), std::domain_error);
}

TEST(WaterSurfaceTension, agrees_with_tables) {
  // mN/m, table of IAPWS R1-76; rounded to 0.01.
  for (const auto& [celsius, value] : {Tabulated{0.01, 75.65}, {20, 72.74}, {25, 71.97}, {50, 67.94}, {80, 62.67}})
    EXPECT_NEAR(water_surface_tension(ice_point + celsius) * 1e3, value, 0.00501) << celsius;
}

TEST(WaterSurfaceTension, falls_to_nothing_at_the_critical_point_and_ends_there) {
  for (double T = water_surface_tension_from; T + 1 <= water_surface_tension_to; T += 1)
    EXPECT_GT(water_surface_tension(T), water_surface_tension(T + 1)) << T;
  EXPECT_EQ(water_surface_tension(water_critical_temperature), 0);
  EXPECT_THROW(water_surface_tension(248), std::domain_error);
  EXPECT_THROW(water_surface_tension(648), std::domain_error);
}

}  // namespace
