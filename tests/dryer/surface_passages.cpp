// How pairs of charged spheres find and leave each other, in the dryer's own integrators.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "common/surface_forces/passage.hpp"
#include "common/surface_forces/stability.hpp"
#include "dryer/brownian.hpp"
#include "dryer/drag.hpp"
#include "dryer/stabilised.hpp"
#include "tests/dryer/in_salt.hpp"
#include "tests/long_version.hpp"
#include "tests/seeds.hpp"

using namespace crumble;
using namespace crumble::dryer;
using namespace crumble::dryer::samples;

namespace {

// First passage. A pair at the gap b touches before it comes to the gap q with the chance
//   P = int_b^q w dh/int_0^q w dh,  w = e^(U/kT)/(2 a + h)^2
// whatever the diffusivity, in free draining. So counting contacts measures int_0^q w dh, and with the rest of the way
// by quadrature W, whose two integrals are measured with and without charge. Gaps are looked at once a long step, so q
// is passed late by 0.58 of its standard deviation (Broadie, Glasserman & Kou 1997).
struct Passage {
  double integral = 0, relative_error = 0;  // int_0^infinity w dh; of sampling
  std::int64_t trials = 0;
};
// make(model, state) is the integrator, at which is looked after each `step`, s.
template <class Make>
Passage measured(const SurfaceForces& f, double b, double q, double step, int contacts, Make make) {
  constexpr int pairs = 64;
  constexpr double apart = 1e-6;
  const DryingModel model = in_bulk(f);
  const auto place = [&](int k, bool even) { return Vector3(apart * k, even ? 0.0 : 0.4e-6, 0); };
  std::vector<Vector3> x;
  std::vector<char> even(pairs, 1);
  for (int k = 0; k < pairs; ++k) x.push_back(place(k, true)), x.push_back(place(k, true) + Vector3(2 * a + b, 0, 0));
  Agglomerate s = spheres(x);
  const auto integrator = make(model, s);
  std::int64_t made = 0, left = 0;
  while (made < contacts) {
    integrator->step(s.state.time + step);
    auto& bonds = s.state.contacts;
    for (int k = 0; k < pairs; ++k) {
      auto& y = s.state.position;
      const auto bond = std::find_if(bonds.begin(), bonds.end(), [&](const Contact& c) { return c.i == 2 * k; });
      const bool escaped = (y[2 * k + 1] - y[2 * k]).norm() > 2 * a + q;
      if (bond == bonds.end() && !escaped) continue;
      ++(escaped ? left : made);
      if (bond != bonds.end()) bonds.erase(bond);
      even[k] = !even[k];
      y[2 * k] = place(k, even[k]);
      y[2 * k + 1] = place(k, even[k]) + Vector3(2 * a + b, 0, 0);
    }
  }
  const double late = 0.5826 * std::sqrt(4 * kT / drag_coefficient(model.viscosity, a) * step);
  const double P = static_cast<double>(made) / static_cast<double>(made + left);
  const std::vector<double> radius{a, a};
  const BondLaws bonds(model.contact, model.material, radius);
  const SurfaceForceLaws laws(f, bonds, radius);
  const auto integral = [&](double from, double to) {
    constexpr int points = 20000;
    double sum = 0;
    for (int k = 0; k < points; ++k) {
      const double h = from + (to - from) * (k + 0.5) / points, r = 2 * a + h;
      sum += std::exp(laws(0, 1).open_energy(h) / kT) / (r * r) * (to - from) / points;
    }
    return sum;
  };
  const double far = laws.range();
  return {integral(b, q + late) / P + integral(q + late, far) + 1 / (2 * a + far),
          std::sqrt((1 - P) / static_cast<double>(made)), made + left};
}

Passage in_two_rates(const SurfaceForces& f, double b, double q, int depth, int contacts, std::uint64_t seed) {
  const DryingModel model = in_bulk(f);
  const double long_step = std::ldexp(Brownian::short_step(model, a, 0.15), depth);
  return measured(f, b, q, long_step, contacts, [&](const DryingModel& m, Agglomerate& s) {
    return std::make_unique<Brownian>(m, s, seed, BrownianControl{0.15, depth});
  });
}
Passage in_long_steps(const SurfaceForces& f, double b, double q, double displacement, int contacts,
                      std::uint64_t seed) {
  const double interval = ThermalLoads::interval(in_bulk(f), a, displacement);
  return measured(f, b, q, interval, contacts, [&](const DryingModel& m, Agglomerate& s) {
    return std::make_unique<Stabilised>(m, s, StabilisedControl{usual_displacement, displacement}, seed);
  });
}

struct Rates {
  const char* name;
  double ionic_strength, W, b, q;  // mol/m^3, -, m, m
  int depth, contacts;
};

class FirstPassage : public ::testing::TestWithParam<Rates> {};

// Bounds: five standard errors of both counts together, 6e-7 by chance, and 2 % for the step and the range, which ends
// at 0.01 kT.
TEST_P(FirstPassage, of_a_pair_gives_the_free_draining_stability_ratio) {
  const Rates& r = GetParam();
  const int contacts = long_version() ? 10 * r.contacts : r.contacts;
  const Passage slow = in_two_rates(forces(4.6e-21, 0.03, r.ionic_strength), r.b, r.q, r.depth, contacts, seeded(1));
  const Passage rapid = in_two_rates(forces(4.6e-21, 0, r.ionic_strength), r.b, r.q, r.depth, contacts, seeded(2));
  const double error = std::hypot(slow.relative_error, rapid.relative_error);
  std::printf("W = %.4g +- %.2g of %lld and %lld pairs\n", slow.integral / rapid.integral,
              error * slow.integral / rapid.integral, static_cast<long long>(slow.trials),
              static_cast<long long>(rapid.trials));
  expect_near("W over that of Fuchs", slow.integral / rapid.integral / r.W, 1, 5 * error + 0.02);
}

INSTANTIATE_TEST_SUITE_P(, FirstPassage,
                         ::testing::Values(Rates{"silica_in_100_mM", 100, 2.784, 1e-9, 3e-9, 2, 1500},
                                           Rates{"silica_in_1_mM", 1, 152.4, 2e-9, 8e-9, 4, 700}),
                         [](const auto& one) { return one.param.name; });

// In long steps: the noise stands while a free particle diffuses so many of the Debye length (root mean square), 0.96
// nm here. Long against it, pairs cross the barrier too rarely; a quarter of it leaves W 8 % too large.
TEST(FirstPassageInLongSteps, gives_the_free_draining_stability_ratio) {
  const int contacts = long_version() ? 6000 : 600;
  for (const double strides : long_version() ? std::vector{1.0, 0.5, 0.25} : std::vector{0.25}) {
    const double displacement = strides * 0.962e-9 / a;
    const Passage slow = in_long_steps(forces(4.6e-21, 0.03, 100), 1e-9, 3e-9, displacement, contacts, seeded(4));
    const Passage rapid = in_long_steps(forces(4.6e-21, 0, 100), 1e-9, 3e-9, displacement, contacts, seeded(5));
    const double error = std::hypot(slow.relative_error, rapid.relative_error), W = slow.integral / rapid.integral;
    std::printf("%g of the Debye length: W = %.4g +- %.2g, without charge %.4g\n", strides, W, error * W,
                2 * a * rapid.integral);
    if (strides <= 0.25) expect_near("W over that of Fuchs", W / 2.784, 1, 5 * error + 0.1);
  }
}

// Rapid coagulation: the measured integral for particles without charge is that of Fuchs with attraction, so that
// particles of 1 % meet within the half time of Smoluchowski over it.
TEST(RapidCoagulation, by_first_passage_has_the_half_time_of_its_attraction) {
  const Passage rapid = in_two_rates(forces(4.6e-21, 0, 1), 1e-9, 3e-9, 2, 1000, seeded(3));
  // Without attraction the integral is 1/(2 a): the half time is longer by the ratio.
  const double enhanced = 2 * a * rapid.integral;
  const VanDerWaals law{4.6e-21, a, a, 0};
  const double expected = std::exp(
      log_stability_ratio([&](double h) { return law.energy(h) / kT; }, [](double) { return 0.0; }, a, Drainage::free));
  expect_near("half time over that of diffusion alone", enhanced / expected, 1, 5 * rapid.relative_error + 0.02);
  EXPECT_LT(enhanced, 1);
}

// A pair in the outer minimum of its energy, 2.0 kT deep at 5.3 nm and closed inwards by a barrier of 55 kT: the mean
// time until its gap first exceeds q, beside the exact integral with the spheres' growing surface, U - 2 kT ln r.
class SecondaryMinimum : public ::testing::TestWithParam<const char*> {};

TEST_P(SecondaryMinimum, is_left_after_the_time_of_the_exact_integral) {
  constexpr double large = 100e-9, q = 10e-9;
  constexpr int pairs = 32;
  SurfaceForces f = forces(9.5e-21, 0.04, 100);
  f.solubility = 100;  // the salt stays as it is, and sets no shorter step
  const DryingModel model = in_bulk(f);
  const std::vector<double> radius{large, large};
  const BondLaws bonds(model.contact, model.material, radius);
  const SurfaceForceLaws laws(f, bonds, radius);
  const auto energy = [&](double h) {
    return laws(0, 1).open_energy(h) / kT - 2 * std::log((2 * large + h) / (2 * large));
  };
  const auto top = barrier([&](double h) { return laws(0, 1).open_energy(h) / kT; }, 0.2e-9, 1e-8);
  ASSERT_TRUE(top);
  const double start = outer_minimum([&](double h) { return laws(0, 1).open_energy(h) / kT; }, top->gap, 5e-8)->gap;

  const auto place = [&](int k) { return Vector3(2e-6 * k, 0, 0); };
  std::vector<Vector3> x;
  for (int k = 0; k < pairs; ++k) x.push_back(place(k)), x.push_back(place(k) + Vector3(2 * large + start, 0, 0));
  Agglomerate s = spheres(x);
  std::fill(s.particles.radius.begin(), s.particles.radius.end(), large);
  std::unique_ptr<Integrator> integrator;
  double step = 0;
  if (std::string(GetParam()) == "two_rates") {
    auto two_rates = std::make_unique<Brownian>(model, s, seeded(6), BrownianControl{0.15, 6});
    step = two_rates->long_step();
    integrator = std::move(two_rates);
  } else {
    const StabilisedControl control{usual_displacement, 0.25 * 0.962e-9 / large};
    step = ThermalLoads::interval(model, large, control.brownian_displacement);
    integrator = std::make_unique<Stabilised>(model, s, control, seeded(7));
  }
  // Of each pair as many, so that short lives do not come first.
  const int lives = long_version() ? 125 : 12;
  std::vector<int> lived(pairs, 0);
  std::vector<double> since(pairs, 0);
  double sum = 0, squares = 0;
  while (*std::min_element(lived.begin(), lived.end()) < lives) {
    integrator->step(s.state.time + step);
    for (int k = 0; k < pairs; ++k) {
      auto& y = s.state.position;
      if (lived[k] == lives || (y[2 * k + 1] - y[2 * k]).norm() < 2 * large + q) continue;
      const double life = s.state.time - since[k];
      sum += life;
      squares += life * life;
      ++lived[k];
      since[k] = s.state.time;
      y[2 * k] = place(k);
      y[2 * k + 1] = place(k) + Vector3(2 * large + start, 0, 0);
    }
  }
  EXPECT_TRUE(s.state.contacts.empty());
  const double count = pairs * lives, mean = sum / count;
  const double error = std::sqrt((squares / count - mean * mean) / count);
  const double D = 2 * kT / drag_coefficient(model.viscosity, large), late = 0.5826 * std::sqrt(2 * D * step);
  const double expected = mean_first_passage(energy, top->gap, start, q + late, D);
  std::printf("%s: %.4g +- %.2g us of %g pairs, by the integral %.4g us\n", GetParam(), 1e6 * mean, 1e6 * error, count,
              1e6 * expected);
  // Five standard errors, 6e-7 by chance, and 2 % for the step.
  expect_near("mean life over the integral", mean / expected, 1, 5 * error / expected + 0.02);
}

INSTANTIATE_TEST_SUITE_P(, SecondaryMinimum, ::testing::Values("two_rates", "long_steps"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
