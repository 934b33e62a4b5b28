// How long and how tightly thermal motion leaves a pair bonded.
#include "dryer/pair_statistics.hpp"

#include <gtest/gtest.h>

#include "dryer/drag.hpp"
#include "dryer/model.hpp"

using namespace crumble;
using namespace crumble::dryer;

namespace {

constexpr double a = 10e-9, kT = boltzmann_constant * 300;

TEST(PairStatistics, of_the_papers_bond) {
  const double zeta = drag_coefficient(1e-3, a);
  const PairStatistics s = pair_statistics(Jkr(Material{}, a), kT, 2 * kT / zeta);
  EXPECT_NEAR(s.rupture / kT, 4.204, 1e-3);
  EXPECT_NEAR(s.lifetime, 2.203e-9, 1e-12);  // sums over a grid ten times as fine
  EXPECT_NEAR(second_virial_ratio(s.well, a), 0.072, 1e-3);
  EXPECT_NEAR(second_virial_ratio(s.stickiness, a), 0.581, 1e-3);
}

TEST(PairStatistics, a_wide_flat_well_lasts_as_long_as_free_diffusion) {
  // Hardly any energy: from h = 0 the gap diffuses to h_po; the well reaches to where the contact pushes back.
  Material weak;
  weak.surface_energy = 1e-5;
  const Jkr law(weak, a);
  const PairStatistics s = pair_statistics(law, kT, 1);
  EXPECT_LT(s.rupture, 1e-3 * kT);
  // MFPT = int_0^h_po (y + w) dy, w the width of the repulsive side: s.well = h_po + w.
  const double h = law.pull_off_gap, w = s.well - h;
  EXPECT_NEAR(s.lifetime, h * w + 0.5 * h * h, 2e-3 * s.lifetime);
}

TEST(PairStatistics, a_softened_bond_is_wider_and_holds_a_pair_as_tightly) {
  const Material stiff;
  const double before = pair_statistics(Jkr(stiff, a), kT, 1).stickiness;
  for (const double factor : {1.5, 2.0, 4.0}) {
    const Material soft = softened(stiff, a, kT, factor);
    EXPECT_NEAR(pair_statistics(Jkr(soft, a), kT, 1).stickiness, before, 1e-6 * before);
    EXPECT_NEAR(Jkr(soft, a).pull_off_gap, factor * Jkr(stiff, a).pull_off_gap, 1e-9 * factor * a);
    EXPECT_LT(Jkr(soft, a).tangent_stiffness(), Jkr(stiff, a).tangent_stiffness() / (factor * factor));
  }
  EXPECT_THROW(softened(stiff, a, kT, 0.5), std::invalid_argument);
}

}  // namespace
