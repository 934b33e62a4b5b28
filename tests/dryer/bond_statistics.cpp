// What bonds do in a closed sphere at equilibrium: the share of time that a pair is bonded, how long it stays together,
// and the number of bonds of 30 particles, for step and softening of the integrator beside the exact law.
//
//   bond_statistics [time of a pair in us, 2000] [time of 30 particles in us, 40]
//
// ±: standard error over independent runs.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "dryer/brownian.hpp"
#include "dryer/drag.hpp"
#include "dryer/pair_statistics.hpp"
#include "tests/dryer/samples.hpp"

using namespace crumble;
using namespace crumble::dryer;
using namespace crumble::dryer::samples;

namespace {

constexpr double a = 10e-9, kT = boltzmann_constant * 300, pair_sphere = 30e-9, sphere_of_30 = 60e-9;
constexpr int runs = 16;

DryingModel closed(double radius, const Material& material) {
  DryingModel model = hollow();
  model.thermal_energy = kT;
  model.droplet = {radius, 1e6, 1.75e-4};
  model.material = material;
  return model;
}

struct Mean {
  double value, error;
};

template <class Sample>
Mean over_runs(Sample sample) {
  double sum = 0, squares = 0;
  for (int run = 0; run < runs; ++run) {
    const double x = sample(static_cast<std::uint64_t>(run));
    sum += x / runs;
    squares += x * x / runs;
  }
  return {sum, std::sqrt((squares - sum * sum) / (runs - 1))};
}

// Surface over volume of the configurations of a pair that does not overlap, weighed with the energy at the droplet's
// surface, 1/m: the odds of a bond are the stickiness times this.
double surface_over_volume(int configurations) {
  const DryingModel model = closed(pair_sphere, {});
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double shell = 0.02 * a, R = pair_sphere + a;
  const auto draw = [&] {
    Vector3 x;
    do x = {uniform(engine), uniform(engine), uniform(engine)};
    while (x.squaredNorm() > 1);
    return Vector3(R * x);
  };
  const auto weight = [&](const Vector3& x) {
    return std::exp(-capillary_energy(model.droplet.surface_tension, a, x.norm() - pair_sphere) / kT);
  };
  double inside = 0, outside = 0;
  for (int k = 0; k < configurations; ++k) {
    const Vector3 x = draw(), y = draw();
    const double gap = (y - x).norm() - 2 * a;
    if (gap < 0) continue;
    const double w = weight(x) * weight(y);
    outside += w;
    // Surfaces grow with the square of the distance: the shell's share at its inner surface.
    if (gap < shell) inside += w * std::pow(2 * a / (2 * a + gap), 2);
  }
  return inside / outside / shell;
}

struct PairRow {
  Mean bonded, lifetime;
};

// A pair is together from a contact until its surfaces are 0.02 a apart.
PairRow pair_row(const Material& material, const BrownianControl& control, double time) {
  const DryingModel model = closed(pair_sphere, material);
  std::vector<double> lifetimes;
  const Mean bonded = over_runs([&](std::uint64_t seed) {
    Agglomerate s = start(2, pair_sphere, seed);
    Brownian integrator(model, s, seed, control);
    double count = 0, together_for = 0;
    int partings = 0;
    bool together = false;
    const auto steps = static_cast<int>(time / runs / integrator.long_step());
    for (int k = 0; k < steps; ++k) {
      integrator.step(1e9);
      const bool is_bonded = !s.state.contacts.empty();
      count += is_bonded;
      const double gap = (s.state.position[1] - s.state.position[0]).norm() - 2 * a;
      if (is_bonded) together = true;
      if (together && !is_bonded && gap > 0.02 * a) {
        together = false;
        ++partings;
      }
      together_for += together;
    }
    lifetimes.push_back(together_for * integrator.long_step() / std::max(partings, 1));
    return count / steps;
  });
  return {bonded, over_runs([&](std::uint64_t run) { return lifetimes[run]; })};
}

Mean bonds_of_30(const Material& material, const BrownianControl& control, double time) {
  const DryingModel model = closed(sphere_of_30, material);
  return over_runs([&](std::uint64_t seed) {
    Agglomerate s = start(30, sphere_of_30, seed);
    Brownian integrator(model, s, seed, control);
    const auto steps = static_cast<int>(time / runs / integrator.long_step());
    double count = 0;
    for (int k = -steps / 4; k < steps; ++k) {  // the first fifth to forget the start
      integrator.step(1e9);
      if (k >= 0) count += static_cast<double>(s.state.contacts.size());
    }
    return count / steps;
  });
}

}  // namespace

int main(int argc, char** argv) {
  const double pair_time = 1e-6 * (argc > 1 ? std::atof(argv[1]) : 2000);
  const double time_of_30 = 1e-6 * (argc > 2 ? std::atof(argv[2]) : 40);
  const double D = 2 * kT / drag_coefficient(1e-3, a);

  fmt::print(
      "| bond | stickiness nm | B2/B2 hard spheres | the same at detailed balance | energy kT | pull-off pN |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  const auto row = [D](const std::string& name, const Material& material) {
    const Jkr law(material, a);
    const PairStatistics s = pair_statistics(law, kT, D);
    fmt::print("| {} | {:.2f} | {:.3f} | {:.3f} | {:.2f} | {:.0f} |\n", name, 1e9 * s.stickiness,
               second_virial_ratio(s.stickiness, a), second_virial_ratio(s.well, a), s.rupture / kT,
               1e12 * law.pull_off_force);
  };
  for (const double factor : {1.0, 1.25, 1.5, 2.0})
    row(fmt::format("softening {:g}", factor), softened({}, a, kT, factor));
  Material same_energy;  // energy ~ (surface energy)^(5/3) E^(-2/3)
  same_energy.youngs_modulus /= 8;
  same_energy.surface_energy *= std::pow(8, -0.4);
  row("E/8 at the same energy", same_energy);
  const double odds = surface_over_volume(40'000'000) * pair_statistics(Jkr({}, a), kT, D).stickiness;
  fmt::print("\nexact law: pair bonded {:.4f} of the time, elementary lifetime {:.3f} ns\n\n", odds / (1 + odds),
             1e9 * pair_statistics(Jkr({}, a), kT, D).lifetime);

  fmt::print("| softening | contact_step | pair bonded | pair together, ns | bonds of 30 |\n|---|---|---|---|---|\n");
  struct Case {
    double softening, step;
    int depth;  // such that all look at the pair about as often, every 64 default steps of the full law
  };
  for (const auto& [softening, step, depth] :
       {Case{1, 0.15 / 16, 10}, Case{1, 0.15, 6}, Case{1.25, 0.15, 5}, Case{1.5, 0.15, 5}, Case{2, 0.15, 4}}) {
    const Material material = softened({}, a, kT, softening);
    const BrownianControl control{step, depth};
    const bool fine = depth > 6;
    const PairRow pair = pair_row(material, control, fine ? pair_time / 4 : pair_time);
    const std::string of_many = fine ? "" : [&] {
      const Mean bonds = bonds_of_30(material, control, time_of_30);
      return fmt::format("{:.2f} ± {:.2f}", bonds.value, bonds.error);
    }();
    fmt::print("| {:g} | {:g} | {:.4f} ± {:.4f} | {:.1f} ± {:.1f} | {} |\n", softening, step, pair.bonded.value,
               pair.bonded.error, 1e9 * pair.lifetime.value, 1e9 * pair.lifetime.error, of_many);
    std::fflush(stdout);
  }
}
