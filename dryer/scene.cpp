#include "dryer/scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/contact/small_contact.hpp"
#include "common/io/plausible.hpp"
#include "common/io/shared_parameters.hpp"
#include "common/io/surface_forces_parameters.hpp"
#include "dryer/inertial.hpp"
#include "dryer/process_inputs.hpp"
#include "dryer/softening.hpp"
#include "dryer/thermal_rupture.hpp"

namespace crumble::dryer {

namespace {

std::vector<double> frames(const Scene& scene) {
  std::vector<double> fraction;
  const auto even = scene.integer("output.frames");
  for (std::int64_t k = 1; k <= even; ++k) fraction.push_back(static_cast<double>(k) / static_cast<double>(even + 1));
  if (scene.is_set("output.theta"))
    for (const double theta : scene.list("output.theta")) fraction.push_back(1 - std::sqrt(1 - theta));
  std::sort(fraction.begin(), fraction.end());
  fraction.erase(std::unique(fraction.begin(), fraction.end()), fraction.end());
  return fraction;
}

// Decided here, once. Overdamped: stabilised steps wherever they know the contact law and no bond breaks thermally.
IntegratorKind integrator_kind(const Scene& scene, const DryingScene& s) {
  const DryingModel& model = s.model;
  const std::string method = scene.choice("integrator.method");
  const bool noise = model.thermal_energy > 0, jkr = model.contact.normal == NormalLaw::jkr;
  if (method == "inertial") return IntegratorKind::inertial;
  if (method == "two-rate" && !noise)
    throw scene.error("integrator.method", "is for particle.brownian_motion; set \"overdamped\"");
  if (noise && method != "implicit") {
    if (!jkr)
      throw scene.error("contact.law",
                        "with particle.brownian_motion the overdamped integrator knows jkr only; set "
                        "integrator.method = \"inertial\"");
    const ThermalRupture rupture = thermal_rupture(s);
    if (method == "stabilised" && !rupture.never())
      throw scene.error("integrator.method",
                        fmt::format("does not know bonds that thermal motion breaks, and they are worth {:.3g} kT; set "
                                    "\"overdamped\"",
                                    rupture.bond));
    return method == "two-rate" || !rupture.never() ? IntegratorKind::brownian : IntegratorKind::stabilised;
  }
  if (noise) throw scene.error("integrator.method", "knows no Brownian motion; set \"overdamped\" or \"inertial\"");
  if (method == "stabilised" && !jkr)
    throw scene.error("integrator.method", "knows the contact law jkr only; set \"implicit\"");
  return method == "implicit" || !jkr ? IntegratorKind::implicit : IntegratorKind::stabilised;
}

// Root mean square displacement of a free particle while its random force stands, in the Debye length at the start: the
// stability ratio then is that of Fuchs within 10 % (tests/dryer/surface_passages.cpp).
constexpr double share_of_debye_length = 0.25;

// What surface forces ask of the other keys.
void take_surface_forces(const Scene& scene, DryingScene& s) {
  // Of a droplet in a gas that at its start.
  s.model.surface_forces =
      surface_forces_in(scene, s.liquid.empty() ? scene.real("fluid.temperature") : s.liquid.front().temperature);
  if (!s.model.surface_forces) return;
  const SurfaceForces& forces = *s.model.surface_forces;
  check_surface_forces(scene, forces, s.model.material, s.smallest_radius(), s.largest_radius());
  if (s.is(IntegratorKind::implicit))
    throw scene.error(
        "integrator.method",
        fmt::format("\"implicit\", which contact.law = \"cundall-strack\" asks for, too, knows no surface forces "
                    "(surface_forces.hamaker, {}): with contact.law = \"jkr\" leave it at \"overdamped\", else set "
                    "\"inertial\"",
                    scene.where("surface_forces.hamaker")));
  if (scene.origin("integrator.softening") == Scene::Origin::given && s.softening != 1 &&
      s.is(IntegratorKind::brownian))
    throw scene.error(
        "integrator.softening",
        "is of bonds alone; with surface_forces contacts have the material's stiffness: set 1, or remove it");
  s.softening = 1;
  // Noise that stands while particles pass the double layer would not let them over its barrier.
  if (scene.origin("integrator.brownian_displacement") != Scene::Origin::given)
    s.stabilised.brownian_displacement =
        std::min(s.stabilised.brownian_displacement,
                 share_of_debye_length / forces.electrolyte.inverse_debye_length() / s.smallest_radius());
}

}  // namespace

DryingModel drying_model(const Scene& scene, const ProcessInputs& process) {
  DryingModel model;
  model.material = material_in(scene);
  take_surface_energy(scene, model.material);
  model.viscosity = process.viscosity;
  model.thermal_energy = process.thermal_energy;
  model.droplet = {scene.real("droplet.radius"), process.lifetime,
                   process.surface_tension * wetting_factor(process.contact_angle),
                   process.gas ? process.gas->curve : nullptr};
  ContactChoice& c = model.contact;
  c = contact_in(scene);
  c.normal = scene.choice("contact.law") == "jkr" ? NormalLaw::jkr : NormalLaw::cundall_strack;
  c.stiffness_factor = scene.real("contact.stiffness_factor");
  c.friction = scene.real("contact.friction");
  model.crust_diffusivity = scene.real("crust.relative_diffusivity");
  model.dry = {scene.flag("dry.everything_acts"), scene.real("dry.drag_factor")};
  return model;
}

DryingScene drying_scene(const Scene& scene, const Machine& machine) {
  require_radius(scene, "particle.radius");
  require_radius(scene, "particle.second_radius");
  require_temperature(scene, "fluid.temperature");
  const ProcessInputs process = process_inputs(scene, machine);
  DryingScene s;
  s.nominal_radius = scene.real("particle.radius");
  s.radius = process.radius;
  s.model = drying_model(scene, process);
  s.surface_tension = process.surface_tension;
  s.contact_angle = process.contact_angle;
  if (process.gas) {
    s.gas = process.gas;
    s.liquid = process.liquid;
    for (LiquidPiece& piece : s.liquid) piece.surface_tension *= wetting_factor(s.contact_angle);
  }
  ContactChoice& c = s.model.contact;
  if (const auto wrong = outside_contact_theory(s.model.material, s.smallest_radius());
      c.normal == NormalLaw::jkr && !wrong.empty())
    throw scene.error("material.youngs_modulus", wrong);
  s.seed = static_cast<std::uint64_t>(scene.integer("run.seed"));
  s.implicit = {scene.real("integrator.largest_displacement"), scene.real("integrator.contact_precision")};
  s.stabilised = {scene.real("integrator.largest_displacement"), scene.real("integrator.brownian_displacement")};
  s.brownian.contact_step = scene.real("integrator.contact_step");
  s.softening = scene.real("integrator.softening");
  s.integrator = integrator_kind(scene, s);
  s.frames = frames(scene);
  s.checkpoint_interval = scene.real("output.checkpoint_interval");
  if (scene.is_set("stands_for.number")) s.stands_for = scene.real("stands_for.number");
  // With noise the paths of two step lengths part; the error is one of means over many seeds.
  s.estimate_error = scene.flag("error.estimate") && s.model.thermal_energy == 0;

  take_surface_forces(scene, s);
  if (!can_be_softened(s, s.softening)) s.softening = 1;

  if (s.is(IntegratorKind::inertial)) {
    const double a = s.smallest_radius();
    const Particles one{{a}, {4.0 / 3.0 * std::numbers::pi * a * a * a * s.model.material.density}, {0}, {0}};
    const double recommended = Inertial::recommended_step(s.model, one);
    s.step = scene.is_set("integrator.step") ? scene.real("integrator.step") : recommended;
    if (s.step > 2.5 * recommended)
      throw scene.error("integrator.step",
                        fmt::format("is beyond the stability limit of the contacts; use at most {:.3g} "
                                    "s, better {:.3g} s",
                                    2.5 * recommended, recommended));
  } else if (scene.is_set("integrator.step")) {
    throw scene.error("integrator.step",
                      "has no meaning to the overdamped integrator, which chooses its steps itself; set "
                      "integrator.method = \"inertial\" or remove it");
  }
  return s;
}

}  // namespace crumble::dryer
