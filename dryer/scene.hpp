// What a drying scene may say, and what it means in numbers.
#pragma once

#include <memory>
#include <optional>

#include "common/io/machine.hpp"
#include "common/io/parameters.hpp"
#include "dryer/brownian.hpp"
#include "dryer/gas/gas_side.hpp"
#include "dryer/implicit.hpp"
#include "dryer/liquid_course.hpp"
#include "dryer/model.hpp"
#include "dryer/stabilised.hpp"

namespace crumble::dryer {

const ParameterTable& drying_parameters();

// Which of the integrators runs: inertial.hpp, implicit.hpp, stabilised.hpp, brownian.hpp.
enum class IntegratorKind { inertial, implicit, stabilised, brownian };

struct DryingScene {
  double nominal_radius = 0;   // a of the scene: of Pe, D; equal to all of the following unless they are distributed, m
  std::vector<double> radius;  // one a particle, descending, m
  double surface_tension = 0;  // sigma of the liquid, N/m; the model's has the factor of the contact angle
  double contact_angle = 0;    // theta, rad
  std::shared_ptr<const GasSide> gas;  // of a scene with [gas]
  std::vector<LiquidPiece> liquid;     // in time; empty without [gas]
  DryingModel model;
  std::uint64_t seed = 1;
  IntegratorKind integrator = IntegratorKind::stabilised;
  double step = 0;  // inertial, s
  ImplicitControl implicit;
  StabilisedControl stabilised;
  BrownianControl brownian;
  double softening = 1;             // of the contacts while particles diffuse
  std::vector<double> frames;       // fractions 1 - R/R0 at which one is due, in order, besides the start and the end
  double checkpoint_interval = 60;  // s of wall time
  bool estimate_error = true;
  std::optional<double> stands_for;  // particles of the droplet for which this smaller one stands

  double smallest_radius() const { return radius.back(); }
  double largest_radius() const { return radius.front(); }
  bool is(IntegratorKind kind) const { return integrator == kind; }
};

// Throws InputError naming file, line and keys where values contradict each other.
// Also if the droplet needs more memory than the machine has.
DryingScene drying_scene(const Scene& scene, const Machine& machine = this_machine());

// The physics of a scene alone, whatever its particles are.
struct ProcessInputs;
DryingModel drying_model(const Scene& scene, const ProcessInputs& process);

}  // namespace crumble::dryer
