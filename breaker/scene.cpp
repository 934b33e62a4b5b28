#include "breaker/scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "common/flow/history_parameters.hpp"
#include "common/io/plausible.hpp"
#include "common/io/shared_parameters.hpp"
#include "common/io/surface_forces_parameters.hpp"

namespace crumble::breaker {

namespace {

using P = Parameter;

Section particle() {
  Section section{
      "particle", "The primary particles.",
      agglomerate_parameters({"refuse", "largest"},
                             "An agglomerate in several pieces: refuse it, or take the largest piece alone")};
  section.parameters.push_back(
      P::choice("contacts", {"close", "keep"},
                "close: all listed contacts start at the gap free of force and without history; keep: gaps and "
                "histories of the file go on, as after an earlier breakup (no scaling)")
          .by_default("close"));
  return section;
}

Section flow() {
  Section section{
      "flow",
      "The flow, linear in space: of one kind, growing as the protocol says, or as a history of its gradient has it.",
      {P::choice("kind", flow_names(),
                 "Planar elongation du_x/dx = -du_z/dz (paper, 3.3), simple shear u_x(y), uniaxial extension along x, "
                 "biaxial along x and y, or none")
           .by_default("elongation")}};
  for (Parameter& p : history_parameters("of which `track` names one")) section.parameters.push_back(std::move(p));
  return section;
}

// The history, if the scene names one: in place of a kind of flow that grows.
Protocol history_in(const Scene& scene, double viscosity) {
  FlowHistory history = flow_history_in(scene);
  if (history.many)
    throw scene.error("flow.history",
                      fmt::format("names {} histories; one granule goes along one of them: flow.track says which (a "
                                  "campaign varies it)",
                                  history.many->size));
  if (!history.one) return Protocol();
  for (const char* key : {"flow.kind", "protocol.strain", "protocol.scale_with_viscosity", "protocol.largest_stress",
                          "breakup.stable_strain", "output.sample_interval", "output.frame_interval"})
    if (scene.is_set(key) && scene.origin(key) == Scene::Origin::given)
      throw scene.error(key, "has no meaning along a history (" + scene.where("flow.history") + ")");
  if (scene.count("protocol.stage") > 0)
    throw scene.error("flow.history", "the flow is that of the history; no [[protocol.stage]] goes with it");
  if (!(history.one->largest_rate() > 0))
    throw scene.error("flow.history", "nothing is strained in it: a fluid that turns like a solid breaks nothing");
  return Protocol(std::make_shared<const GradientHistory>(std::move(*history.one)), viscosity);
}

Protocol protocol_in(const Scene& scene, double stretch) {
  std::vector<Stage> stages;
  for (std::size_t k = 0; k < scene.count("protocol.stage"); ++k) {
    const std::string place = fmt::format("protocol.stage[{}].", k);
    const std::string& kind = scene.choice(place + "kind");
    const auto needed = [&](const char* key) {
      if (!scene.is_set(place + key)) throw scene.error(place + "kind", fmt::format("needs '{}'", key));
      return scene.real(place + key);
    };
    for (const char* key : {"duration", "stress", "rate", "from", "to"}) {
      const bool of_ramp = key == std::string("rate") || key == std::string("from") || key == std::string("to");
      if (scene.is_set(place + key) &&
          (of_ramp != (kind == "ramp") || (kind == "rest" && key == std::string("stress"))))
        throw scene.error(place + key, "has no meaning where kind = \"" + kind + "\"");
    }
    if (!stages.empty() && std::isinf(stages.back().duration))
      throw scene.error(place + "kind", "nothing can follow a ramp without 'to', which goes on until the run ends");
    if (kind == "ramp") {
      Stage ramp{scene.is_set(place + "from") ? scene.real(place + "from") : 0, needed("rate") / stretch};
      if (scene.is_set(place + "to")) {
        const double end = scene.real(place + "to");
        if (end <= ramp.stress) throw scene.error(place + "to", "is at or below the stress where the ramp starts");
        ramp.duration = (end - ramp.stress) / ramp.rate;
      }
      stages.push_back(ramp);
    } else {
      stages.push_back({kind == "hold" ? needed("stress") : 0, 0, stretch * needed("duration")});
    }
  }
  return Protocol(std::move(stages));
}

}  // namespace

const ParameterTable& breaker_parameters() {
  static const BreakerScene usual;
  static const ParameterTable table{
      particle(),
      material_section(),
      contact_section(),
      loading_fluid_section(),
      surface_forces_section(),
      hydrodynamics_section(
          {"fts", "fts-lubrication", "fts-relative-lubrication"}, "fts-relative-lubrication",
          "Far field; with pair lubrication as in Eq. 9; with pair lubrication on relative motion only"),
      flow(),
      {"protocol",
       "How strong the flow is at which time, as flow stress mu gamma_dot. Without any [[protocol.stage]] it is one "
       "ramp from rest that follows from the strength of the agglomerate taken as rigid.",
       {P::real("strain", "", "Of that ramp, up to the stress at which the rigid agglomerate would break")
            .above(0)
            .by_default(usual.ramp_strain),
        P::flag("scale_with_viscosity",
                "Take the stages as those for 1 Pa s: multiply times by mu/(1 Pa s) and divide rates, which gives "
                "the same states at the same stresses for every viscosity")
            .by_default(true),
        P::real("largest_stress", "Pa",
                "The run ends here if nothing breaks; without it twenty times the stress at which the rigid "
                "agglomerate would break")
            .above(0)
            .optional()}},
      {"protocol.stage",
       "The stages in order, each from its own [[protocol.stage]].",
       {P::choice("kind", {"rest", "hold", "ramp"},
                  "rest: no flow for `duration`; hold: `stress` for `duration`; ramp: `rate` from `from` to `to`"),
        P::real("duration", "s", "rest, hold: how long").above(0).optional(),
        P::real("stress", "Pa", "hold: flow stress").at_least(0).optional(),
        P::real("rate", "Pa s-1", "ramp: growth of the flow stress").above(0).optional(),
        P::real("from", "Pa", "ramp: where it starts; without it 0").at_least(0).optional(),
        P::real("to", "Pa", "ramp: where it ends; without it it goes on until breakup").above(0).optional()},
       true,
       {"protocol.stages"}},
      {"breakup",
       "When an agglomerate counts as broken.",
       {P::real("reach", "", "A fragment is lost when its surface is farther than this from the rest, in a")
            .above(0.01)
            .at_most(10)
            .by_default(usual.reach),
        P::integer("lost_particles",
                   "How many particles must be lost, in one fragment or crumb by crumb, for it to be broken; without "
                   "it a twentieth of all, rounded up")
            .at_least(1)
            .optional(),
        P::flag("until_stable", "After breakup hold the stress until no fragment breaks any more").by_default(false),
        P::real("stable_strain", "", "until_stable: strain without a rupture that counts as stable")
            .above(0)
            .by_default(usual.stable_strain),
        P::real(
            "brittle_below", "",
            "Relative change of the largest semi-axis, 1 % of stress before breakup, below which it is called brittle")
            .above(0)
            .by_default(usual.brittle_below)}},
      {"integrator",
       "How the equations are solved.",
       {P::choice("method", {"implicit", "explicit"},
                  "implicit: adaptive, in the frame of the turning body; explicit: the paper's, fixed step, slow")
            .by_default("implicit"),
        P::real("tolerance", "", "implicit: of the range of a bond; breaker/MODEL.md says what it controls")
            .above(1e-6)
            .at_most(0.1)
            .by_default(usual.tolerance),
        P::real("step", "s", "explicit: the fixed step; without it half of the stability limit").above(0).optional(),
        P::flag("allow_unstable", "explicit: take a step beyond the stability limit all the same").by_default(false)}},
      {"error",
       "How the run judges itself.",
       {P::flag("estimate", "Also run with doubled tolerance (or, explicit, half the step) and report the difference")
            .by_default(usual.estimate_error),
        P::real("accuracy", "",
                "implicit: wanted relative error of the critical stress; while the difference is larger the tolerance "
                "is halved and the breakup run again")
            .above(0)
            .by_default(usual.accuracy),
        P::integer("halvings", "How often at most")
            .at_least(0)
            .at_most(10)
            .by_default(static_cast<int>(usual.halvings))}},
      {"output",
       "What the file holds.",
       {P::real("sample_interval", "Pa",
                "Between two samples of the dense series; without it a 200th of the stress at which the rigid "
                "agglomerate would break")
            .above(0)
            .optional(),
        P::real("frame_interval", "Pa", "Between two frames; without it a 20th of that stress").above(0).optional(),
        checkpoint_interval_parameter()}}};
  return table;
}

BreakerScene breaker_scene(const Scene& scene) {
  BreakerScene s;
  require_radius(scene, "particle.radius");
  if (scene.is_set("particle.radius")) s.radius = scene.real("particle.radius");
  s.keep_contacts = scene.choice("particle.contacts") == "keep";
  if (s.keep_contacts && s.radius)
    throw scene.error("particle.contacts", "particle.radius (" + scene.where("particle.radius") +
                                               ") scales the agglomerate, which no contact survives");
  s.only_largest = scene.choice("particle.fragments") == "largest";
  s.largest_gap = scene.real("particle.largest_gap");
  s.model.material = material_in(scene);
  take_surface_energy(scene, s.model.material);
  s.model.surface_forces = surface_forces_in(scene, scene.real("fluid.temperature"));
  s.model.contact = contact_in(scene);
  s.liquid = liquid_in(scene);
  s.model.viscosity = s.liquid.viscosity;
  s.model.hydro = lubrication_in(scene, rung_named(scene.choice("hydrodynamics.method")));
  s.flow = flow_named(scene.choice("flow.kind"));
  s.model.gradient = unit_gradient(s.flow);
  s.ramp_strain = scene.real("protocol.strain");
  s.protocol = protocol_in(scene, scene.flag("protocol.scale_with_viscosity") ? s.model.viscosity : 1);
  if (Protocol history = history_in(scene, s.model.viscosity); history.has_history()) s.protocol = std::move(history);
  if (!s.protocol.has_history() && s.protocol.stages().empty() && s.flow == FlowKind::quiescent)
    throw scene.error("flow.kind",
                      "nothing follows from the strength where nothing flows: say how long in "
                      "[[protocol.stage]]");
  if (scene.is_set("protocol.largest_stress")) s.largest_stress = scene.real("protocol.largest_stress");
  s.reach = scene.real("breakup.reach");
  if (scene.is_set("breakup.lost_particles")) s.lost_particles = scene.integer("breakup.lost_particles");
  s.until_stable = scene.flag("breakup.until_stable");
  s.stable_strain = scene.real("breakup.stable_strain");
  s.brittle_below = scene.real("breakup.brittle_below");
  s.integrator =
      scene.choice("integrator.method") == "explicit" ? IntegratorKind::explicit_euler : IntegratorKind::implicit;
  s.tolerance = scene.real("integrator.tolerance");
  if (scene.is_set("integrator.step")) {
    if (s.is(IntegratorKind::implicit))
      throw scene.error("integrator.step",
                        "has no meaning to the implicit integrator, which chooses its steps itself; set "
                        "integrator.method = \"explicit\" or remove it");
    s.step = scene.real("integrator.step");
  }
  s.allow_unstable = scene.flag("integrator.allow_unstable");
  s.estimate_error = scene.flag("error.estimate");
  s.accuracy = scene.real("error.accuracy");
  s.halvings = scene.integer("error.halvings");
  s.checkpoint_interval = scene.real("output.checkpoint_interval");
  if (scene.is_set("output.sample_interval")) s.sample_interval = scene.real("output.sample_interval");
  if (scene.is_set("output.frame_interval")) s.frame_interval = scene.real("output.frame_interval");
  return s;
}

void adapt(BreakerScene& s, double strength) {
  if (s.flow == FlowKind::quiescent) {
    // Nothing grows: an interval says how often only in a flow.
    for (double* stress : {&s.largest_stress, &s.sample_interval, &s.frame_interval})
      if (*stress == 0) *stress = 1;
    return;
  }
  if (s.protocol.has_history()) {
    s.rigid_strength = strength;
    s.model.weak_stress = 1e-3 * strength;
    s.sample_interval = s.protocol.end() / 1000;
    s.frame_interval = s.protocol.end() / 50;
    return;
  }
  // Up to the stress S a ramp of rate r has strained by S^2/(2 r mu).
  if (s.protocol.stages().empty())
    s.protocol = Protocol({{0, strength * strength / (2 * s.ramp_strain * s.model.viscosity)}});
  s.rigid_strength = strength;
  s.model.weak_stress = 1e-3 * strength;
  if (s.largest_stress == 0) s.largest_stress = 20 * strength;
  if (s.sample_interval == 0) s.sample_interval = strength / 200;
  if (s.frame_interval == 0) s.frame_interval = strength / 20;
}

}  // namespace crumble::breaker
