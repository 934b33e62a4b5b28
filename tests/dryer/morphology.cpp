// The final morphology discriminates the physics (N = 115, five starts each). Sources of the expected values: counting
// of constraints (isostatic packings: coordination 6 without friction, 4 with sliding friction alone), the paper's
// Table 2, and an independent JKR simulation with LAMMPS 2022.
#include <gtest/gtest.h>

#include "common/agglomerate/morphology.hpp"
#include "dryer/stabilised.hpp"
#include "tests/dryer/samples.hpp"

using namespace crumble;

namespace {

struct Means {
  double d_c = 0, h_c = 0, contacts = 0, coordination = 0;
};

Means five_starts(const ContactChoice& contact) {
  Means means;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    DryingModel model = samples::hollow();
    model.contact = contact;
    Agglomerate state = samples::start(115, 215e-9, seed);
    // Steps of 0.05 a: contacts and d_c differ from those at 0.01 a by far less than the scatter of the starts.
    Stabilised integrator(model, state, {.largest_displacement = 0.05});
    while (state.state.time < model.droplet.lifetime) integrator.step(model.droplet.lifetime);
    const Morphology m = morphology(state.particles, state.state);
    means.d_c += 0.2e9 * m.extent.diameter();
    means.h_c += 0.2 * m.extent.relative_crust();
    means.contacts += 0.2 * static_cast<double>(m.contacts);
    means.coordination += 0.2 * m.coordination;
  }
  return means;
}

TEST(Morphology, of_the_defaults_is_that_of_table_2) {
  const Means m = five_starts({});
  EXPECT_NEAR(m.d_c, 160, 5);
  EXPECT_NEAR(m.h_c, 0.31, 0.03);
  EXPECT_GE(m.contacts, 165);
  EXPECT_LE(m.contacts, 182);
}

TEST(Morphology, without_sliding_and_rolling_resistance_is_isostatic) {
  const Means m = five_starts({.sliding_limit_factor = 0, .twisting_limit_factor = 0, .rolling_limit_factor = 0});
  EXPECT_NEAR(m.coordination, 6.0, 0.1);
}

TEST(Morphology, with_sliding_resistance_alone_has_coordination_4) {
  const Means m = five_starts({.twisting_limit_factor = 0, .rolling_limit_factor = 0});
  EXPECT_NEAR(m.coordination, 4.0, 0.15);
}

// Bonds that neither slip, twist nor bend: k_r of Eq. 20 is so soft that chains of a few particles bend under the
// capillary force (2.4 contacts a particle); ten times as stiff, the network is nearly a tree.
TEST(Morphology, of_bonds_that_cannot_roll_is_nearly_a_tree) {
  const Means m =
      five_starts({.twisting_limit_factor = 1e6, .rolling_limit_factor = 1e6, .rolling_stiffness_factor = 10});
  EXPECT_NEAR(m.coordination, 2.2, 0.15);
}

}  // namespace
