// What a breaker scene may say.
#pragma once

#include <optional>

#include "breaker/model.hpp"
#include "breaker/protocol.hpp"
#include "common/agglomerate/rescaled.hpp"
#include "common/hydro/flow_kind.hpp"
#include "common/io/parameters.hpp"
#include "common/io/service_load.hpp"

namespace crumble::breaker {

const ParameterTable& breaker_parameters();

// Which of the integrators runs: implicit.hpp, explicit_euler.hpp.
enum class IntegratorKind { implicit, explicit_euler };

struct BreakerScene {
  std::optional<double> radius;  // m
  bool keep_contacts = false, only_largest = false;
  double largest_gap = largest_listed_gap;  // in a
  BreakupModel model;
  Liquid liquid;  // that of the model, with its density
  FlowKind flow = FlowKind::elongation;
  Protocol protocol;         // without stages or a history: adapt() makes the ramp
  double ramp_strain = 500;  // of that ramp, up to the rigid strength
  IntegratorKind integrator = IntegratorKind::implicit;
  double tolerance = 0.01;
  double step = 0;  // explicit only, s; 0: half the stability limit
  bool allow_unstable = false;
  double reach = 1;                            // gap beyond which a fragment is lost, in a
  std::optional<std::int64_t> lost_particles;  // whose loss is the breakup; else a twentieth of all, rounded up
  double checkpoint_interval = 60;             // s of wall time
  bool until_stable = false;
  double stable_strain = 20;   // without rupture, at constant stress
  double brittle_below = 0.1;  // relative change of the largest semi-axis
  bool estimate_error = true;
  double accuracy = 0.01;     // of the critical stress, relative; while its error is larger the tolerance is halved,
  std::int64_t halvings = 2;  // at most so often
  double rigid_strength = 0;  // Pa, of the agglomerate; adapt() sets it
  double largest_stress = 0, sample_interval = 0, frame_interval = 0;  // Pa (along a history s); 0: adapt() says

  std::string flow_name() const { return protocol.has_history() ? "history" : name_of(flow); }
  bool is(IntegratorKind kind) const { return integrator == kind; }
};

// Throws InputError naming file, line and keys where values contradict each other.
BreakerScene breaker_scene(const Scene& scene);

// Fills what the scene leaves to the strength of the agglomerate, the stress at which it would break if it were rigid:
// the ramp, at which stress the run ends, and how often it writes. strength: Pa, > 0.
void adapt(BreakerScene& scene, double strength);

}  // namespace crumble::breaker
