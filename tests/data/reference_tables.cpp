#include <gtest/gtest.h>

#include "common/contact/bond_law.hpp"
#include "common/hydro/two_sphere.hpp"
#include "tests/data/csv_table.hpp"

using namespace crumble;

namespace {

// Half a unit of the last printed digit, and a little for the rounding of the decimal number itself.
void expect_printed(const Row& row, const std::string& column, double value) {
  EXPECT_NEAR(value, number(row, column), 0.501 * last_digit(row.at(column))) << column;
}

TEST(PaperTables, table_1_is_what_the_material_of_the_code_defaults_to) {
  std::map<std::string, double> value;
  for (const Row& row : read_table("paper_table_1.csv")) value[row.at("symbol")] = number(row, "value");
  const Material material;
  EXPECT_DOUBLE_EQ(material.density, value.at("rho_p"));
  EXPECT_DOUBLE_EQ(material.youngs_modulus, value.at("E"));
  EXPECT_DOUBLE_EQ(material.poisson_ratio, value.at("nu"));
  EXPECT_DOUBLE_EQ(material.surface_energy, value.at("gamma_s"));
}

TEST(ContactTables, constants_are_those_of_the_contact_laws_to_every_printed_digit) {
  const auto rows = read_table("contact_constants.csv");
  ASSERT_EQ(rows.size(), 3u);
  for (const Row& row : rows) {
    SCOPED_TRACE("a = " + row.at("radius_nm") + " nm");
    const double a = 1e-9 * number(row, "radius_nm");
    const BondLaw bond({}, Material{}, a, a);
    expect_printed(row, "b0_nm", 1e9 * bond.jkr.zero_load_radius);
    expect_printed(row, "h_po_nm", 1e9 * bond.jkr.pull_off_gap);
    expect_printed(row, "h_eq_nm", 1e9 * bond.jkr.equilibrium_gap);
    expect_printed(row, "F_po_N", bond.jkr.pull_off_force);
    expect_printed(row, "k_n_N_per_m", bond.jkr.tangent_stiffness());
    expect_printed(row, "k_s_N_per_m", bond.k_s);
    expect_printed(row, "k_t_N_m", bond.k_t);
    expect_printed(row, "k_r_N_m", bond.k_r);
    expect_printed(row, "F_s_crit_N", bond.F_s_crit);
    expect_printed(row, "M_r_crit_N_m", bond.M_r_crit);
  }
}

TEST(ContactTables, pull_test_of_another_code_agrees_with_the_contact_law_within_half_a_percent) {
  const Row row = read_table("contact_pull_test.csv").at(0);
  const double a = 1e-9 * number(row, "radius_nm");
  const Jkr jkr(Material{}, a);
  // The test moved the spheres in small steps, which places the gap of rupture to 1e-4 nm and the slope to 1e-2 N/m.
  const auto expect_close = [&](const char* column, double value) {
    EXPECT_NEAR(value / number(row, column), 1, 5e-3) << column;
  };
  // The force is stationary where it is largest, so that the step enters in second order only.
  EXPECT_NEAR(1e12 * jkr.pull_off_force / number(row, "pull_off_force_pN"), 1, 1e-5);
  expect_close("pull_off_gap_nm", 1e9 * jkr.pull_off_gap);
  expect_close("zero_load_gap_nm", 1e9 * jkr.equilibrium_gap);
  expect_close("k_n_N_per_m", jkr.tangent_stiffness());
  expect_close("work_of_detachment_J", jkr.energy(jkr.pull_off_gap));
}

std::map<std::string, double> by_name(const ResistanceScalars& f) {
  std::map<std::string, double> out;
  for (int k = 0; k < ResistanceScalars::count; ++k) out[ResistanceScalars::names[k]] = f.values()[k];
  return out;
}

TEST(TwoSphereTables, functions_are_those_of_the_code) {
  for (const Row& row : read_table("two_sphere_functions.csv")) {
    const auto f = by_name(two_sphere_resistance(number(row, "gap_over_a")));
    for (const auto& [name, printed] : row) {
      if (name == "gap_over_a") continue;
      // The compiled table is accurate to 2e-8 of a function, or of 1 where that is more.
      EXPECT_NEAR(f.at(name), std::stod(printed), 2e-8 * std::max(1.0, std::abs(std::stod(printed))))
          << name << " at gap " << row.at("gap_over_a");
    }
  }
}

TEST(TwoSphereTables, functions_approach_their_printed_forms_near_contact) {
  for (const Row& row : read_table("two_sphere_limits.csv"))
    for (const double gap : {1e-4, 1e-5}) {
      const auto f = by_name(two_sphere_resistance(gap));
      const auto coefficient = [&](const char* name) { return row.contains(name) ? number(row, name) : 0; };
      const double form = coefficient("inverse") / gap - coefficient("logarithm") * std::log(gap) +
                          coefficient("constant") - coefficient("x_logarithm") * gap * std::log(gap);
      // The constants are printed to four digits; what is left out is of order gap ln(1/gap) < 1e-3.
      EXPECT_NEAR(f.at(row.at("function")), form, 1e-4 + gap * std::log(1 / gap)) << row.at("function") << " " << gap;
    }
}

}  // namespace
