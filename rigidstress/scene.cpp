#include "rigidstress/scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "common/io/number_list.hpp"
#include "common/io/plausible.hpp"

namespace crumble {

const ParameterTable& stress_parameters() {
  using P = Parameter;
  static const ParameterTable table{
      {"particle",
       "The primary particles.",
       {P::real("radius", "m",
                "Mean radius a to which the agglomerate is scaled (the paper dries at 10 nm and loads at 100 nm); "
                "without it the file's own")
            .above(0)
            .optional()}},
      {"material",
       "What the particles are made of (paper, Table 1).",
       {P::real("youngs_modulus", "Pa", "Elastic modulus E").above(0).by_default(3.4e9),
        P::real("poisson_ratio", "", "Poisson ratio nu").above(-1).at_most(0.5).by_default(0.5),
        P::real("surface_energy", "J m-2", "Superficial energy gamma_s of one surface").above(0).by_default(4.8e-3)}},
      {"fluid",
       "The fluid around the agglomerate.",
       {P::real("viscosity", "Pa s",
                "Viscosity mu; only a velocity-gradient history needs it, all else is said per mu gamma_dot")
            .above(0)
            .by_default(1e-3)}},
      {"structure",
       "How contacts share the loads: elastic joints of six degrees of freedom.",
       {P::choice("normal_stiffness", {"tangent", "secant"},
                  "k_n of JKR: its tangent at rest, or the secant from rest to pull-off (0.6 of the tangent)")
            .by_default("tangent"),
        P::real("twisting_factor", "", "Of the twisting stiffness k_t (Eq. 16)").at_least(0).by_default(1),
        P::real("bending_factor", "", "Of the bending stiffness k_r (Eq. 20)").at_least(0).by_default(1),
        P::choice("fragments", {"refuse", "each"},
                  "An agglomerate in several pieces: refuse it, or analyse each piece as if it were alone in the flow")
            .by_default("refuse"),
        P::real("largest_gap", "", "A listed contact whose surfaces are farther apart is refused, in a")
            .above(0)
            .by_default(0.2)}},
      {"hydrodynamics",
       "How the load of the fluid on each sphere is found.",
       {P::choice("method", {"auto", "fts", "fts-lubrication", "fts-relative-lubrication", "multipole"},
                  "auto: the cheapest of fts and multipoles of rising order whose estimated error is within the "
                  "tolerance; fts-lubrication overestimates rigid clusters and is there to reproduce older work")
            .by_default("auto"),
        P::integer("order", "multipole: degree L of the moments").at_least(1).at_most(20).by_default(3),
        P::real("lubrication_range", "", "Lubrication: pairs of centres closer than this, in mean radii")
            .above(2)
            .by_default(2.5),
        P::real("tolerance", "", "auto: relative error of the largest tension").above(0).below(1).by_default(0.01),
        P::real("memory", "B", "Largest matrix allowed").above(0).by_default(4e9),
        P::flag("estimate", "A fixed multipole order: also compute the lower ones that the error estimate needs")
            .by_default(true)}},
      {"flow",
       "Which flows; each costs milliseconds and no factorisation.",
       {P::flag("elongation", "Planar elongation, worst and settled orientation (paper, 3.3)").by_default(true),
        P::flag("shear", "Simple shear, tumbling orbits (paper, 3.4)").by_default(true),
        P::flag("uniaxial", "Uniaxial extension").by_default(false),
        P::flag("biaxial", "Biaxial extension").by_default(false),
        P::text("history",
                "CSV file of time [s] and nine components of the velocity gradient [1/s], as seen from the scene")
            .optional(),
        P::real("largest_history_step", "", "A longer strain between two rows of the history is refused")
            .above(0)
            .by_default(1),
        P::integer("starts", "Elongation: random orientations from which the agglomerate settles")
            .at_least(1)
            .at_most(100000)
            .by_default(64),
        P::integer("orbits", "Shear and history: random orientations to start from")
            .at_least(1)
            .at_most(100000)
            .by_default(10),
        P::text(
            "orientation",
            "Shear and history: one orbit from here instead, a quaternion \"w,x,y,z\" that turns the axes of the file "
            "into those of the flow; 1,0,0,0 as it lies")
            .optional(),
        P::real("strain", "", "Shear: duration in 1/gamma_dot; one turn takes 4 pi or longer")
            .above(0)
            .at_most(1e6)
            .by_default(100),
        P::real("sample", "", "Shear: interval between instants, in 1/gamma_dot").above(0).at_most(1).by_default(0.1),
        P::real("orientation_tolerance", "", "Error of the orientation in one step, rad")
            .above(0)
            .at_most(1e-2)
            .by_default(1e-8)}},
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
  if (!scene.is_set("flow.orientation"))
    return random_orientations(seed, static_cast<int>(scene.integer("flow.orbits")));
  try {
    const std::vector<double> q = number_list(scene.text("flow.orientation"));
    if (q.size() != 4) throw std::invalid_argument(fmt::format("{} numbers, four are needed", q.size()));
    const Quaternion start(q[0], q[1], q[2], q[3]);
    if (!(start.norm() > 0) || !std::isfinite(start.norm())) throw std::invalid_argument("names no orientation");
    return {start.normalized()};
  } catch (const std::invalid_argument& error) {
    throw scene.error("flow.orientation", error.what());
  }
}

}  // namespace

std::vector<ReadFile> history_files(const Scene& scene) {
  if (!scene.is_set("flow.history")) return {};
  const auto file = std::filesystem::path(scene.file()).parent_path() / scene.text("flow.history");
  return {{"the history", file.string()}};
}

StressScene stress_scene(const Scene& scene) {
  StressScene s;
  require_radius(scene, "particle.radius");
  if (scene.is_set("particle.radius")) s.radius = scene.real("particle.radius");
  s.material.youngs_modulus = scene.real("material.youngs_modulus");
  s.material.poisson_ratio = scene.real("material.poisson_ratio");
  s.material.surface_energy = scene.real("material.surface_energy");
  s.viscosity = scene.real("fluid.viscosity");
  s.joint.normal =
      scene.choice("structure.normal_stiffness") == "tangent" ? NormalStiffness::tangent : NormalStiffness::secant;
  s.joint.twisting_factor = scene.real("structure.twisting_factor");
  s.joint.bending_factor = scene.real("structure.bending_factor");
  s.each_fragment = scene.choice("structure.fragments") == "each";
  s.largest_gap = scene.real("structure.largest_gap");
  HydrodynamicChoice& h = s.hydrodynamics;
  h.method = method_named(scene.choice("hydrodynamics.method"));
  h.order = static_cast<int>(scene.integer("hydrodynamics.order"));
  h.lubrication_range = scene.real("hydrodynamics.lubrication_range");
  h.tolerance = scene.real("hydrodynamics.tolerance");
  h.memory = scene.real("hydrodynamics.memory");
  h.estimate = scene.flag("hydrodynamics.estimate");
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
  if (scene.is_set("flow.history")) {
    s.history = GradientHistory::read(history_files(scene).front().name, scene.real("flow.largest_history_step"));
  }
  return s;
}

std::string response_key(const Scene& scene) {
  std::string key;
  for (const Section& section : stress_parameters()) {
    if (section.name == "fluid" || section.name == "flow" || section.name == "run") continue;
    for (const Parameter& p : section.parameters) {
      const std::string name = section.name + "." + p.name;
      if (!scene.is_set(name)) continue;
      key += name + " = ";
      switch (p.kind) {
        case Parameter::Kind::real:
          key += toml_text(scene.real(name));
          break;
        case Parameter::Kind::integer:
          key += toml_text(scene.integer(name));
          break;
        case Parameter::Kind::flag:
          key += toml_text(scene.flag(name));
          break;
        case Parameter::Kind::choice:
          key += scene.choice(name);
          break;
        case Parameter::Kind::text:
          key += scene.text(name);
          break;
      }
      key += "\n";
    }
  }
  return key;
}

}  // namespace crumble
