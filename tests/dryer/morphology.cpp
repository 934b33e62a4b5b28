// The final morphology discriminates the physics (N = 115, means over a few starts). Sources of the expected values:
// counting of constraints (isostatic packings: coordination 6 without friction, 4 with sliding friction alone), the
// paper's Table 2, and an independent JKR simulation with LAMMPS 2022. Spreads are standard deviations between starts.
#include <gtest/gtest.h>

#include <cmath>

#include "common/agglomerate/morphology.hpp"
#include "dryer/stabilised.hpp"
#include "tests/data/csv_table.hpp"
#include "tests/dryer/samples.hpp"
#include "tests/seeds.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

struct Means {
  double d_c = 0, h_c = 0, contacts = 0, coordination = 0;
};

Means dried(int starts, const ContactChoice& contact) {
  Means means;
  for (int seed = 1; seed <= starts; ++seed) {
    DryingModel model = samples::hollow();
    model.contact = contact;
    Agglomerate state = samples::start(115, 215e-9, seeded(static_cast<std::uint64_t>(seed)));
    // Steps of 0.05 a: contacts and d_c differ from those at 0.01 a by far less than the scatter of the starts.
    Stabilised integrator(model, state, {.largest_displacement = 0.05});
    while (state.state.time < model.droplet.lifetime) integrator.step(model.droplet.lifetime);
    const Morphology m = morphology(state.particles, state.state);
    means.d_c += 1e9 * m.extent.diameter() / starts;
    means.h_c += m.extent.relative_crust() / starts;
    means.contacts += static_cast<double>(m.contacts) / starts;
    means.coordination += m.coordination / starts;
  }
  return means;
}

// Beside the one hollow granule of the paper: d_c and h_c/d_c of Table 2, contacts (183 to 185) of section 3.2. Ours,
// the mean of 40 starts, are 1 % larger, their crust is thicker by 0.011 d_c, both within the scatter of single
// granules (2.6 % and 0.023), and they have 11 % fewer contacts (scatter 2 %; pipeline/verify/NOTEBOOK.md tells which
// choice decides them). Bounds: 4.5 standard errors of eight starts beside 40, 7e-6 by chance each.
TEST(Morphology, of_the_defaults_is_that_of_table_2_but_for_a_tenth_of_the_contacts) {
  const Row paper = read_table("paper_table_2.csv").front();
  ASSERT_EQ(paper.at("peclet"), "inf");
  constexpr int starts = 8;
  const double errors = 4.5 * std::sqrt(1.0 / starts + 1.0 / 40);
  const Means m = dried(starts, {});
  expect_near("d_c over the paper's", m.d_c / number(paper, "d_c_nm"), 1.010, errors * 0.026);
  expect_near("h_c/d_c beside the paper's", m.h_c - number(paper, "h_c_over_d_c"), 0.011, errors * 0.023);
  expect_near("contacts over the paper's", m.contacts / 184, 0.894, errors * 0.019);
}

// 3 N - 6 contacts, a law of counting, but for what bonds add that pull and loose particles lack: 340.3 in the mean for
// 339, which is 0.023 in the coordination; of 20 sets of four starts 5.956 +- 0.018, the law's 5.896. The bound is five
// standard deviations of a set from that mean: 6e-7 by chance.
TEST(Morphology, without_sliding_and_rolling_resistance_is_isostatic) {
  const Means m = dried(4, {.sliding_limit_factor = 0, .twisting_limit_factor = 0, .rolling_limit_factor = 0});
  expect_near("coordination", m.coordination, 6 - 12.0 / 115, 0.15);
}

// At least the 2 N - 2 contacts of friction that never yields, a law of counting; more where sliding yields: 4.14 in
// the mean, 0.031 between starts, so that the upper bound is six standard errors of three starts away, the law nine.
TEST(Morphology, with_sliding_resistance_alone_has_the_contacts_that_friction_needs_and_few_more) {
  const Means m = dried(3, {.twisting_limit_factor = 0, .rolling_limit_factor = 0});
  expect_within("coordination", m.coordination, 4 - 4.0 / 115, 4.25);
}

// Bonds that neither slip, twist nor bend: k_r of Eq. 20 is so soft that chains of a few particles bend under the
// capillary force (2.4 contacts a particle); ten times as stiff, the network is nearly a tree: 2.21 in the mean, 0.032
// between starts, which leaves six standard errors of two.
TEST(Morphology, of_bonds_that_cannot_roll_is_nearly_a_tree) {
  const Means m = dried(2, {.twisting_limit_factor = 1e6, .rolling_limit_factor = 1e6, .rolling_stiffness_factor = 10});
  expect_near("coordination", m.coordination, 2.2, 0.15);
}

}  // namespace
