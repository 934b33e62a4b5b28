#include "breaker/scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "common/hydro/linear_flow.hpp"
#include "common/io/plausible.hpp"

namespace crumble {

const ParameterTable& breaker_parameters() {
  using P = Parameter;
  static const ParameterTable table{
      {"particle",
       "The primary particles.",
       {P::real("radius", "m",
                "Mean radius a to which the agglomerate is scaled (the paper dries at 10 nm and breaks at 100 nm); "
                "without it the file's own")
            .above(0)
            .optional(),
        P::choice("contacts", {"close", "keep"},
                  "close: all listed contacts start at the gap free of force and without history; keep: gaps and "
                  "histories of the file go on, as after an earlier breakup (no scaling)")
            .by_default("close"),
        P::choice("fragments", {"refuse", "largest"},
                  "An agglomerate in several pieces: refuse it, or take the largest piece alone")
            .by_default("refuse"),
        P::real("largest_gap", "", "A listed contact whose surfaces are farther apart is refused, in a")
            .above(0)
            .by_default(0.2)}},
      {"material",
       "What the particles are made of (paper, Table 1).",
       {P::real("youngs_modulus", "Pa", "Elastic modulus E").above(0).by_default(3.4e9),
        P::real("poisson_ratio", "", "Poisson ratio nu").above(-1).at_most(0.5).by_default(0.5),
        P::real("surface_energy", "J m-2", "Superficial energy gamma_s of one surface").above(0).by_default(4.8e-3)}},
      {"contact",
       "The bond between two particles. A limit factor multiplies the critical load of the paper's equation: 0 takes "
       "the resistance away, 1e6 makes it elastic without limit in practice.",
       {P::real("sliding_limit_factor", "", "Of the critical sliding force (Eq. 14)").at_least(0).by_default(1),
        P::real("twisting_limit_factor", "", "Of the critical twisting torque (Eq. 17)").at_least(0).by_default(1),
        P::real("rolling_limit_factor", "", "Of the critical rolling torque (Eqs. 20-21)").at_least(0).by_default(1),
        P::real("rolling_stiffness_factor", "", "Of the rolling stiffness k_r (Eq. 20); the critical torque stays")
            .above(0)
            .by_default(1)}},
      {"fluid",
       "The fluid around the agglomerate.",
       {P::real("viscosity", "Pa s",
                "Viscosity mu. The paper does not say it; its time step and its alignment by 1000 Pa imply about 1")
            .above(0)
            .by_default(1)}},
      {"hydrodynamics",
       "How the spheres act on each other through the fluid.",
       {P::choice("method", {"fts", "fts-lubrication", "fts-relative-lubrication"},
                  "Far field; with pair lubrication as in Eq. 9; with pair lubrication on relative motion only")
            .by_default("fts-relative-lubrication"),
        P::real("lubrication_range", "", "Pairs of centres closer than this, in mean radii").above(2).by_default(2.5),
        P::real("gap_floor", "",
                "Closer pairs, all contacts among them, are lubricated as at this gap, in a; their centres are "
                "taken apart to it, so that rigid motion and uniform strain stay consistent")
            .above(1e-6)
            .at_most(0.1)
            .by_default(1e-3)}},
      {"flow",
       "The flow, linear in space.",
       {P::choice("kind", {"elongation", "shear", "uniaxial", "quiescent"},
                  "Planar elongation du_x/dx = -du_z/dz (paper, 3.3), simple shear u_x(y), uniaxial extension along x, "
                  "or none")
            .by_default("elongation")}},
      {"protocol",
       "How strong the flow is at which time, as flow stress mu gamma_dot.",
       {P::text("stages",
                "Stages in order: 'rest S' and 'hold PA for S' (seconds), 'ramp PA_PER_S [from PA] [to PA]'; a ramp "
                "without 'to' goes on until breakup. The default is the paper's")
            .by_default("rest 0.1; hold 2 for 0.1; ramp 5000"),
        P::flag("scale_with_viscosity",
                "Take the stages as those for 1 Pa s: multiply times by mu/(1 Pa s) and divide rates, which gives "
                "the same states at the same stresses for every viscosity")
            .by_default(true),
        P::real("largest_stress", "Pa", "The run ends here if nothing breaks").above(0).by_default(1e5)}},
      {"breakup",
       "When an agglomerate counts as broken.",
       {P::real("reach", "", "A fragment is lost when its surface is farther than this from the rest, in a")
            .above(0.01)
            .at_most(10)
            .by_default(1),
        P::integer("lost_particles",
                   "How many particles must be lost, in one fragment or crumb by crumb, for it to be broken; without "
                   "it a twentieth of all, rounded up")
            .at_least(1)
            .optional(),
        P::flag("until_stable", "After breakup hold the stress until no fragment breaks any more").by_default(false),
        P::real("stable_strain", "", "until_stable: strain without a rupture that counts as stable")
            .above(0)
            .by_default(20),
        P::real(
            "brittle_below", "",
            "Relative change of the largest semi-axis, 1 % of stress before breakup, below which it is called brittle")
            .above(0)
            .by_default(0.1)}},
      {"integrator",
       "How the equations are solved.",
       {P::choice("method", {"implicit", "explicit"},
                  "implicit: adaptive, in the frame of the turning body; explicit: the paper's, fixed step, slow")
            .by_default("implicit"),
        P::real("tolerance", "", "implicit: of the range of a bond; breaker/README.md says what it controls")
            .above(1e-6)
            .at_most(0.1)
            .by_default(0.01),
        P::real("step", "s", "explicit: the fixed step; without it half of the stability limit").above(0).optional(),
        P::flag("allow_unstable", "explicit: take a step beyond the stability limit all the same").by_default(false)}},
      {"error",
       "How the run judges itself.",
       {P::flag("estimate", "Also run with doubled tolerance (or, explicit, half the step) and report the difference")
            .by_default(true),
        P::real("accuracy", "",
                "implicit: wanted relative error of the critical stress; while the difference is larger the tolerance "
                "is halved and the breakup run again")
            .above(0)
            .by_default(0.01),
        P::integer("halvings", "How often at most").at_least(0).at_most(10).by_default(2)}},
      {"output",
       "What the file holds.",
       {P::real("sample_interval", "Pa", "Between two samples of the dense series").above(0).by_default(5),
        P::real("frame_interval", "Pa", "Between two frames").above(0).by_default(50)}}};
  return table;
}

namespace {

Eigen::Matrix3d gradient_of(const std::string& kind) {
  Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
  if (kind == "elongation") return planar_elongation(1).gradient;
  if (kind == "shear") g(0, 1) = 1;
  if (kind == "uniaxial") g.diagonal() = Vector3(1, -0.5, -0.5) / std::sqrt(3.0);
  return g;
}

Rung rung_named(const std::string& name) {
  if (name == "fts") return Rung::fts;
  return name == "fts-lubrication" ? Rung::fts_lubrication : Rung::fts_relative_lubrication;
}

}  // namespace

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
  s.model.material.youngs_modulus = scene.real("material.youngs_modulus");
  s.model.material.poisson_ratio = scene.real("material.poisson_ratio");
  s.model.material.surface_energy = scene.real("material.surface_energy");
  ContactChoice& c = s.model.contact;
  c.sliding_limit_factor = scene.real("contact.sliding_limit_factor");
  c.twisting_limit_factor = scene.real("contact.twisting_limit_factor");
  c.rolling_limit_factor = scene.real("contact.rolling_limit_factor");
  c.rolling_stiffness_factor = scene.real("contact.rolling_stiffness_factor");
  s.model.viscosity = scene.real("fluid.viscosity");
  s.model.hydro.rung = rung_named(scene.choice("hydrodynamics.method"));
  s.model.hydro.lubrication_range = scene.real("hydrodynamics.lubrication_range");
  s.model.hydro.gap_floor = scene.real("hydrodynamics.gap_floor");
  const std::string& kind = scene.choice("flow.kind");
  s.flow = kind == "elongation" ? "elongational" : kind;
  s.model.gradient = gradient_of(kind);
  try {
    s.protocol = Protocol::parse(scene.text("protocol.stages"),
                                 scene.flag("protocol.scale_with_viscosity") ? s.model.viscosity : 1);
  } catch (const std::invalid_argument& error) {
    throw scene.error("protocol.stages", error.what());
  }
  s.largest_stress = scene.real("protocol.largest_stress");
  s.reach = scene.real("breakup.reach");
  if (scene.is_set("breakup.lost_particles")) s.lost_particles = scene.integer("breakup.lost_particles");
  s.until_stable = scene.flag("breakup.until_stable");
  s.stable_strain = scene.real("breakup.stable_strain");
  s.brittle_below = scene.real("breakup.brittle_below");
  s.is_explicit = scene.choice("integrator.method") == "explicit";
  s.tolerance = scene.real("integrator.tolerance");
  if (scene.is_set("integrator.step")) {
    if (!s.is_explicit)
      throw scene.error("integrator.step",
                        "has no meaning to the implicit integrator, which chooses its steps itself; set "
                        "integrator.method = \"explicit\" or remove it");
    s.step = scene.real("integrator.step");
  }
  s.allow_unstable = scene.flag("integrator.allow_unstable");
  s.estimate_error = scene.flag("error.estimate");
  s.accuracy = scene.real("error.accuracy");
  s.halvings = scene.integer("error.halvings");
  s.sample_interval = scene.real("output.sample_interval");
  s.frame_interval = scene.real("output.frame_interval");
  return s;
}

}  // namespace crumble
