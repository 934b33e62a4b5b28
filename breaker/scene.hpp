// What a breaker scene may say.
#pragma once

#include <optional>

#include "breaker/model.hpp"
#include "breaker/protocol.hpp"
#include "common/io/parameters.hpp"

namespace crumble {

const ParameterTable& breaker_parameters();

struct BreakerScene {
  std::optional<double> radius;  // m
  bool keep_contacts = false, only_largest = false;
  double largest_gap = 0.2;  // of listed contacts, in a
  BreakupModel model;
  std::string flow;  // as the agglomerate file calls it
  Protocol protocol;
  bool is_explicit = false;
  double tolerance = 0.01;
  double step = 0;  // explicit only, s; 0: half the stability limit
  bool allow_unstable = false;
  double reach = 1;                            // gap beyond which a fragment is lost, in a
  std::optional<std::int64_t> lost_particles;  // whose loss is the breakup; else a twentieth of all, rounded up
  bool until_stable = false;
  double stable_strain = 20;    // without rupture, at constant stress
  double largest_stress = 1e5;  // Pa
  double brittle_below = 0.1;   // relative change of the largest semi-axis
  bool estimate_error = true;
  double accuracy = 0.01;     // of the critical stress, relative; while its error is larger the tolerance is halved,
  std::int64_t halvings = 2;  // at most so often
  double sample_interval = 5, frame_interval = 50;  // Pa
};

// Throws InputError naming file, line and keys where values contradict each other.
BreakerScene breaker_scene(const Scene& scene);

}  // namespace crumble
