// What a granule must bear, in any unit, and the answer.
#include "common/io/service_load.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/hydro/turbulence.hpp"
#include "common/io/errors.hpp"

using namespace crumble;

namespace {

constexpr Liquid water{1e-3, 1000};
constexpr double round_off = 1e-12;

GranuleStrength strength(std::optional<double> stress, std::optional<double> error = 0.01) {
  return {stress, 50, "elongation, worst orientation", error, "estimated", 0.05, "file", 2e-6};
}

}  // namespace

TEST(ServiceLoad, stress_rate_and_dissipation_are_one_load_in_three_units) {
  const ServiceLoad by_rate = service_load("1e4 1/s", water);
  EXPECT_NEAR(by_rate.stress, 10, 10 * round_off);
  EXPECT_NEAR(service_load("10 Pa", water).shear_rate, 1e4, 1e4 * round_off);
  // sqrt(epsilon/nu) = 1e4/s at nu = 1e-6 m2/s: 100 W/kg.
  const ServiceLoad turbulent = service_load("100 W/kg", water);
  EXPECT_NEAR(turbulent.shear_rate, 1e4, 1e4 * round_off);
  EXPECT_NEAR(turbulent.stress, 10, 10 * round_off);
  EXPECT_NEAR(*turbulent.eddies, std::pow(1e-18 / 100, 0.25), 1e-5 * round_off);
  EXPECT_FALSE(by_rate.eddies);
}

// Kolmogorov: an eddy of the length eta turns at the rate sqrt(epsilon/nu) where eta^2 rate/nu = 1.
TEST(ServiceLoad, the_smallest_eddies_have_a_reynolds_number_of_one) {
  for (const double epsilon : {1e-3, 1.0, 1e4}) {
    const double eta = kolmogorov_length(epsilon, 2e-6);
    EXPECT_NEAR(eta * eta * kolmogorov_shear_rate(epsilon, 2e-6) / 2e-6, 1, round_off);
  }
}

TEST(ServiceLoad, everything_else_is_refused_with_the_three_forms) {
  for (const char* wrong : {"100", "Pa", "100 bar", "-1 Pa", "0 Pa", "1e400 Pa", "100 Pa Pa", "ten Pa", "10 W"}) {
    try {
      service_load(wrong, water);
      ADD_FAILURE() << wrong << " was taken";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("\"1e4 1/s\""), std::string::npos) << error.what();
    }
  }
}

TEST(ServiceLoad, the_verdict_leaves_open_what_the_numerical_error_leaves_open) {
  const auto at = [](const char* load) { return verdict(service_load(load, water), strength(100)); };
  EXPECT_EQ(at("10 Pa"), Verdict::holds);
  EXPECT_EQ(at("99.5 Pa"), Verdict::undecided);
  EXPECT_EQ(at("100.5 Pa"), Verdict::undecided);
  EXPECT_EQ(at("110 Pa"), Verdict::breaks);
  // Nothing broke up to 50 Pa.
  EXPECT_EQ(verdict(service_load("49 Pa", water), strength(std::nullopt)), Verdict::holds);
  EXPECT_EQ(verdict(service_load("51 Pa", water), strength(std::nullopt)), Verdict::undecided);
}

TEST(ServiceLoad, the_sentence_names_the_three_errors) {
  const std::string text = answer_text(service_load("0.6 Pa", water), strength(100));
  EXPECT_NE(text.find("0.6 Pa = 600 1/s in this liquid: holds, at 0.6 % of its strength of 100 Pa"), text.npos) << text;
  EXPECT_NE(text.find("numerical 1 % (estimated)"), text.npos) << text;
  EXPECT_NE(text.find("sampling not known from one granule"), text.npos) << text;
  EXPECT_NE(text.find("surface energy, 0.05 J/m2 (file): with 0.0003 J/m2 it would break just here"), text.npos)
      << text;
  EXPECT_NE(answer_text(service_load("1 Pa", water), strength(100, std::nullopt)).find("numerical not known"),
            text.npos);
}

TEST(ServiceLoad, a_granule_larger_than_the_smallest_eddies_is_told_so) {
  GranuleStrength large = strength(100);
  large.diameter = 1e-3;
  EXPECT_NE(answer_text(service_load("10 W/kg", water), large).find("larger than the Kolmogorov length"),
            std::string::npos);
  EXPECT_EQ(answer_text(service_load("10 W/kg", water), strength(100)).find("Kolmogorov"), std::string::npos);
}
