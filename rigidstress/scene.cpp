#include "rigidstress/scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "common/io/plausible.hpp"
#include "common/io/shared_parameters.hpp"
#include "common/io/surface_forces_parameters.hpp"

namespace crumble::rigidstress {

namespace {

using P = Parameter;

Section fluid() {
  Section section = loading_fluid_section();
  section.meaning += " Only shear rates and a velocity-gradient history need it, all else is said per mu gamma_dot.";
  return section;
}

Section hydrodynamics() {
  const HydrodynamicChoice standard;
  Section section = hydrodynamics_section(
      {"auto", "fts", "fts-lubrication", "fts-relative-lubrication", "multipole"}, "auto",
      "auto: the cheapest of fts and multipoles of rising order whose estimated error is within error.accuracy; "
      "fts-lubrication overestimates rigid clusters and is there to reproduce older work");
  section.parameters.push_back(
      P::integer("order", "multipole: degree L of the moments").at_least(1).at_most(20).by_default(standard.order));
  section.parameters.push_back(P::real("memory", "B", "Largest matrix allowed").above(0).by_default(standard.memory));
  return section;
}

Section flow() {
  Section section{
      "flow",
      "Which flows; each costs milliseconds and no factorisation.",
      {P::flag("elongation", "Planar elongation, worst and settled orientation (paper, 3.3)").by_default(true),
       P::flag("shear", "Simple shear, tumbling orbits (paper, 3.4)").by_default(true),
       P::flag("uniaxial", "Uniaxial extension").by_default(false),
       P::flag("biaxial", "Biaxial extension").by_default(false)}};
  for (Parameter& p : history_parameters("for first exits over the strength"))
    section.parameters.push_back(std::move(p));
  for (const Parameter& p :
       {P::integer("starts", "Elongation: evenly spread orientations from which the agglomerate settles")
            .at_least(1)
            .at_most(100000)
            .by_default(64),
        P::integer("orbits",
                   "Shear and history: evenly spread orientations to start from; 128 give the mean over all to 2 %")
            .at_least(1)
            .at_most(100000)
            .by_default(128),
        P::list("orientation", "",
                "Shear and history: one orbit from here instead, a quaternion [w, x, y, z] that turns the axes of the "
                "file into those of the flow; [1, 0, 0, 0] as it lies")
            .optional(),
        P::real("strain", "", "Shear: duration in 1/gamma_dot; one turn takes 4 pi or longer")
            .above(0)
            .at_most(1e6)
            .by_default(100),
        P::real("sample", "", "Shear: interval between instants, in 1/gamma_dot").above(0).at_most(1).by_default(0.1),
        P::real("orientation_tolerance", "", "Error of the orientation in one step, rad")
            .above(0)
            .at_most(1e-2)
            .by_default(1e-8)})
    section.parameters.push_back(p);
  return section;
}

}  // namespace

const ParameterTable& stress_parameters() {
  static const ParameterTable table{
      {"particle", "The primary particles.",
       agglomerate_parameters({"refuse", "largest", "each"},
                              "An agglomerate in several pieces: refuse it, take the largest piece alone, or analyse "
                              "each piece as if it were alone in the flow")},
      material_section(),
      fluid(),
      surface_forces_section(),
      {"contact",
       "How contacts share the loads: elastic joints of six degrees of freedom.",
       {P::choice("normal_stiffness", {"tangent", "secant"},
                  "k_n of JKR: its tangent at rest, or the secant from rest to pull-off (0.6 of the tangent)")
            .by_default("tangent")
            .formerly("structure.normal_stiffness"),
        P::real("twisting_stiffness_factor", "", "Of the twisting stiffness k_t (Eq. 16)")
            .at_least(0)
            .by_default(JointChoice{}.twisting_factor)
            .formerly("structure.twisting_factor"),
        rolling_stiffness_parameter().at_least(0)}},
      hydrodynamics(),
      {"error",
       "How the run judges itself.",
       {P::real("accuracy", "", "method = auto: wanted relative error of the largest tension")
            .above(0)
            .below(1)
            .by_default(HydrodynamicChoice{}.accuracy)
            .formerly("hydrodynamics.tolerance"),
        P::flag("estimate", "A fixed multipole order: also compute the lower ones that the error estimate needs")
            .by_default(true)
            .formerly("hydrodynamics.estimate")}},
      flow(),

      {"output", "What the run keeps.", {checkpoint_interval_parameter()}},
      {"run", "The run itself.", {P::integer("seed", "Names the random orientations").at_least(0).by_default(1)}}};
  return table;
}

namespace {

Method method_named(const std::string& name) {
  if (name == "fts") return Method::fts;
  if (name == "fts-lubrication") return Method::fts_lubrication;
  if (name == "fts-relative-lubrication") return Method::fts_relative_lubrication;
  return name == "multipole" ? Method::multipole : Method::automatic;
}

std::vector<Quaternion> starts(const Scene& scene, std::uint64_t seed) {
  if (!scene.is_set("flow.orientation")) return even_orientations(seed, static_cast<int>(scene.integer("flow.orbits")));
  try {
    const std::vector<double>& q = scene.list("flow.orientation");
    if (q.size() != 4) throw std::invalid_argument(fmt::format("{} numbers, four are needed", q.size()));
    const Quaternion start(q[0], q[1], q[2], q[3]);
    if (!(start.norm() > 0) || !std::isfinite(start.norm())) throw std::invalid_argument("names no orientation");
    return {start.normalized()};
  } catch (const std::invalid_argument& error) {
    throw scene.error("flow.orientation", error.what());
  }
}

}  // namespace

StressScene stress_scene(const Scene& scene) {
  StressScene s;
  require_radius(scene, "particle.radius");
  if (scene.is_set("particle.radius")) s.radius = scene.real("particle.radius");
  s.material = material_in(scene);
  take_surface_energy(scene, s.material);
  s.surface_forces = surface_forces_in(scene, scene.real("fluid.temperature"));
  s.liquid = liquid_in(scene);
  s.joint.normal =
      scene.choice("contact.normal_stiffness") == "tangent" ? NormalStiffness::tangent : NormalStiffness::secant;
  s.joint.twisting_factor = scene.real("contact.twisting_stiffness_factor");
  s.joint.bending_factor = scene.real("contact.rolling_stiffness_factor");
  const std::string& pieces = scene.choice("particle.fragments");
  s.pieces = pieces == "each" ? Pieces::each : pieces == "largest" ? Pieces::largest : Pieces::refuse;
  s.largest_gap = scene.real("particle.largest_gap");
  HydrodynamicChoice& h = s.hydrodynamics;
  h.method = method_named(scene.choice("hydrodynamics.method"));
  h.order = static_cast<int>(scene.integer("hydrodynamics.order"));
  h.lubrication = lubrication_in(scene, Rung::fts_relative_lubrication);
  h.accuracy = scene.real("error.accuracy");
  h.memory = scene.real("hydrodynamics.memory");
  h.estimate = scene.flag("error.estimate");
  s.checkpoint_interval = scene.real("output.checkpoint_interval");
  s.elongation = scene.flag("flow.elongation");
  s.shear = scene.flag("flow.shear");
  s.uniaxial = scene.flag("flow.uniaxial");
  s.biaxial = scene.flag("flow.biaxial");
  s.seed = static_cast<std::uint64_t>(scene.integer("run.seed"));
  s.straining.starts = static_cast<int>(scene.integer("flow.starts"));
  s.straining.seed = s.seed;
  s.orbit.starts = starts(scene, s.seed);
  s.orbit.strain = scene.real("flow.strain");
  s.orbit.sample = scene.real("flow.sample");
  s.orbit.tolerance = scene.real("flow.orientation_tolerance");
  if (s.orbit.sample > s.orbit.strain) throw scene.error("flow.sample", "is longer than flow.strain");
  constexpr double most = 1e7;  // instants of an orbit, 40 bytes each
  if (s.orbit.strain > most * s.orbit.sample)
    throw scene.error("flow.sample", fmt::format("makes {:.2g} instants of every orbit; at least {:g} makes {:g}",
                                                 s.orbit.strain / s.orbit.sample, s.orbit.strain / most, most));
  FlowHistory history = flow_history_in(scene);
  if (history.many && scene.is_set("flow.orientation"))
    throw scene.error("flow.orientation", "many tracks start from as many random orientations");
  s.history = std::move(history.one);
  s.tracks = std::move(history.many);
  return s;
}

std::string response_key(const Scene& scene) {
  std::string key;
  for (const Section& section : stress_parameters()) {
    if (section.name == "fluid" || section.name == "flow" || section.name == "output" || section.name == "run")
      continue;
    for (const Parameter& p : section.parameters) {
      const std::string name = section.name + "." + p.name;
      if (!scene.is_set(name)) continue;
      key += name + " = ";
      key += toml_text(*scene.value(name));
      key += "\n";
    }
  }
  return key;
}

}  // namespace crumble::rigidstress
