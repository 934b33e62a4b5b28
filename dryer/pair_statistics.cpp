#include "dryer/pair_statistics.hpp"

#include <cmath>
#include <stdexcept>

namespace crumble::dryer {

PairStatistics pair_statistics(const Jkr& law, double kT, double diffusivity) {
  // From where the energy is 40 kT above the minimum, in even steps of the gap.
  double deepest = law.equilibrium_gap;
  while (law.energy(deepest) < 40 * kT) deepest += 0.5 * law.equilibrium_gap;
  constexpr int below = 4000, above = 2000;
  const double barrier = law.energy(law.pull_off_gap);
  const auto weight = [&](double h) { return std::exp((barrier - law.energy(h)) / kT); };
  double inner = 0, step = -deepest / below, before = weight(deepest);
  for (int k = 1; k <= below; ++k) {
    const double now = weight(deepest + k * step);
    inner += 0.5 * step * (before + now);
    before = now;
  }
  double passage = 0;
  step = law.pull_off_gap / above;
  for (int k = 1; k <= above; ++k) {
    const double now = weight(k * step), next = inner + 0.5 * step * (before + now);
    passage += 0.5 * step * (inner / before + next / now);
    inner = next;
    before = now;
  }
  return {passage / diffusivity, passage / law.pull_off_gap, inner, barrier};
}

double second_virial_ratio(double stickiness, double a) { return 1 - 1.5 * stickiness / a; }

Material softened(const Material& material, double a, double kT, double factor) {
  if (!(factor >= 1)) throw std::invalid_argument("softening must be at least 1");
  if (factor == 1) return material;
  // b0^2/a and h_po go like (gamma/E)^(2/3).
  const auto with_energy = [&](double share) {
    Material soft = material;
    soft.surface_energy *= share;
    soft.youngs_modulus *= share / std::pow(factor, 1.5);
    return soft;
  };
  const double target = pair_statistics(Jkr(material, a), kT, 1).stickiness;
  const auto excess = [&](double share) {
    return std::log(pair_statistics(Jkr(with_energy(share), a), kT, 1).stickiness / target);
  };
  double high = 1, too_much = excess(high), low = high, too_little = too_much;
  while (too_little > 0) {
    low /= 2;
    if (low < 1e-9) throw std::invalid_argument("no softer contact holds a pair as tightly");
    too_little = excess(low);
  }
  // Rule of false position, an end that stays counted half (Illinois).
  while (high - low > 1e-12 * high) {
    const double share = (low * too_much - high * too_little) / (too_much - too_little), value = excess(share);
    if (std::abs(value) < 1e-11) return with_energy(share);
    if (value > 0) {
      high = share;
      too_much = value;
      too_little /= 2;
    } else {
      low = share;
      too_little = value;
      too_much /= 2;
    }
  }
  return with_energy(high);
}

}  // namespace crumble::dryer
