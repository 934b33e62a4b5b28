// Small droplets for the tests.
#pragma once

#include <numbers>

#include "dryer/model.hpp"
#include "dryer/start.hpp"

namespace crumble::dryer::samples {

// Table 2, first row.
inline DryingModel hollow() {
  DryingModel model;
  model.droplet = {215e-9, 2.1e-4, 1.75e-4};
  return model;
}

inline Agglomerate spheres(const std::vector<Vector3>& position, double a = 10e-9) {
  Agglomerate state;
  for (std::size_t p = 0; p < position.size(); ++p) {
    state.particles.radius.push_back(a);
    state.particles.mass.push_back(4.0 / 3.0 * std::numbers::pi * a * a * a * 1300);
    state.particles.id.push_back(static_cast<std::int64_t>(p));
    state.particles.species.push_back(0);
  }
  state.state.position = position;
  return state;
}

inline Agglomerate start(int number, double droplet_radius, std::uint64_t seed) {
  return random_suspension(std::vector<double>(number, 10e-9), 1300, droplet_radius, seed);
}

}  // namespace crumble::dryer::samples
