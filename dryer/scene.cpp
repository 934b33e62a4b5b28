#include "dryer/scene.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "dryer/drag.hpp"
#include "dryer/inertial.hpp"

namespace crumble {

const ParameterTable& drying_parameters() {
  using P = Parameter;
  static const ParameterTable table{
      {"particle",
       "The primary particles: equal spheres.",
       {P::real("radius", "m", "Radius a").above(0), P::integer("number", "How many, N").at_least(1),
        P::flag("brownian_motion",
                "Brownian force and torque (Eqs. 4-5) at liquid.temperature; false: D = 0, Pe = infinity")
            .by_default(false)}},
      {"material",
       "What the particles are made of (paper, Table 1).",
       {P::real("youngs_modulus", "Pa", "Elastic modulus E").above(0).by_default(3.4e9),
        P::real("poisson_ratio", "", "Poisson ratio nu").above(-1).at_most(0.5).by_default(0.5),
        P::real("surface_energy", "J m-2", "Superficial energy gamma_s of one surface").above(0).by_default(4.8e-3),
        P::real("density", "kg m-3", "Density rho_p; matters to the inertial integrator only")
            .above(0)
            .by_default(1300)}},
      {"liquid",
       "The liquid of the droplet.",
       {P::real("viscosity", "Pa s", "Viscosity mu").above(0).by_default(1e-3),
        P::real("surface_tension", "N m-1",
                "Surface tension sigma. The default is the paper's reduced value; water has 0.072")
            .at_least(0)
            .by_default(1.75e-4),
        P::real("temperature", "K", "Temperature T of droplet and particles").above(0).by_default(300)}},
      {"droplet",
       "The droplet: R(t)^2 = R0^2 (1 - t/lifetime).",
       {P::real("radius", "m", "Radius R0 at the start").above(0),
        P::real("lifetime", "s", "Time tau at which the liquid is gone").above(0)}},
      {"contact",
       "The bond between two touching particles. A limit factor multiplies the critical load of the paper's equation: "
       "0 "
       "takes the resistance away, 1e6 makes it elastic without limit in practice.",
       {P::choice(
            "law", {"jkr", "cundall-strack"},
            "Normal force: JKR (Eq. 10), or a linear spring with the pull-off force of Eq. 6 and Coulomb friction")
            .by_default("jkr"),
        P::real("stiffness_factor", "", "cundall-strack: spring stiffness in units of E a").above(0).by_default(1),
        P::real("friction", "", "cundall-strack: tangent of the friction angle").at_least(0).by_default(0.5),
        P::real("sliding_limit_factor", "", "Of the critical sliding force (Eq. 14, or Coulomb friction)")
            .at_least(0)
            .by_default(1),
        P::real("twisting_limit_factor", "", "Of the critical twisting torque (Eq. 17)").at_least(0).by_default(1),
        P::real("rolling_limit_factor", "", "Of the critical rolling torque (Eqs. 20-21)").at_least(0).by_default(1),
        P::real("rolling_stiffness_factor", "", "Of the rolling stiffness k_r (Eq. 20); the critical torque stays")
            .above(0)
            .by_default(1)}},
      {"integrator",
       "How the equations are solved.",
       {P::choice("method", {"overdamped", "inertial"},
                  "overdamped: no inertia, implicit contacts, adaptive; inertial: the paper's scheme, fixed step, slow")
            .by_default("overdamped"),
        P::real("largest_displacement", "", "overdamped: largest motion of a particle in one step, in a")
            .above(0)
            .at_most(0.1)
            .by_default(0.02),
        P::real("contact_precision", "", "overdamped: overlap within which a new contact is located, in a")
            .above(0)
            .at_most(1e-2)
            .by_default(1e-4),
        P::real("step", "s", "inertial: the fixed step; without it a fifth of the time scale of the stiffest contact")
            .above(0)
            .optional()}},
      {"error",
       "How the run judges itself.",
       {P::flag("estimate", "Also run with doubled step control (about half as long again) and report the difference")
            .by_default(true)}},
      {"output",
       "What the file holds.",
       {P::integer("frames", "Frames between start and end, evenly spaced in the radius of the droplet")
            .at_least(0)
            .at_most(100000)
            .by_default(50)}},
      {"run", "The run itself.", {P::integer("seed", "Names the random start").at_least(0).by_default(1)}}};
  return table;
}

DryingScene drying_scene(const Scene& scene) {
  DryingScene s;
  const double a = scene.real("particle.radius");
  s.radius.assign(static_cast<std::size_t>(scene.integer("particle.number")), a);
  s.model.material = {scene.real("material.youngs_modulus"), scene.real("material.poisson_ratio"),
                      scene.real("material.surface_energy"), scene.real("material.density")};
  s.model.viscosity = scene.real("liquid.viscosity");
  if (scene.flag("particle.brownian_motion"))
    s.model.thermal_energy = boltzmann_constant * scene.real("liquid.temperature");
  s.model.droplet = {scene.real("droplet.radius"), scene.real("droplet.lifetime"),
                     scene.real("liquid.surface_tension")};
  ContactChoice& c = s.model.contact;
  c.normal = scene.choice("contact.law") == "jkr" ? NormalLaw::jkr : NormalLaw::cundall_strack;
  c.stiffness_factor = scene.real("contact.stiffness_factor");
  c.friction = scene.real("contact.friction");
  c.sliding_limit_factor = scene.real("contact.sliding_limit_factor");
  c.twisting_limit_factor = scene.real("contact.twisting_limit_factor");
  c.rolling_limit_factor = scene.real("contact.rolling_limit_factor");
  c.rolling_stiffness_factor = scene.real("contact.rolling_stiffness_factor");
  s.seed = static_cast<std::uint64_t>(scene.integer("run.seed"));
  s.inertial = scene.choice("integrator.method") == "inertial";
  s.control = {scene.real("integrator.largest_displacement"), scene.real("integrator.contact_precision")};
  s.frames = static_cast<int>(scene.integer("output.frames"));
  s.estimate_error = scene.flag("error.estimate");

  const double R0 = s.model.droplet.initial_radius;
  if (a >= R0)
    throw scene.error("particle.radius", fmt::format("no particle fits into droplet.radius = {:g} m ({})", R0,
                                                     scene.where("droplet.radius")));
  // Random sequential addition jams at 38 % of the volume that centres can take; long before that it crawls.
  const double solids = static_cast<double>(s.radius.size()) * std::pow(a / R0, 3);
  if (solids > 0.3)
    throw scene.error(
        "particle.number",
        fmt::format("fills {:.0f} % of the droplet with solids; a random start is possible up to 30 %, that is "
                    "{:.0f} particles",
                    100 * solids, 0.3 * std::pow(R0 / a, 3)));
  if (s.inertial) {
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

std::vector<std::string> describe(const DryingScene& s) {
  const double a = s.radius.front(), R0 = s.model.droplet.initial_radius, mu = s.model.viscosity;
  const double sigma = s.model.droplet.surface_tension;
  const double n = static_cast<double>(s.radius.size());
  const double start_speed = s.model.droplet.front_speed(R0);
  // Where the front would be when the solids fill half of the droplet.
  const double R_packed = std::min(R0, a * std::cbrt(2 * n)), packed_speed = s.model.droplet.front_speed(R_packed);
  const double limit = sigma / (3 * mu);
  const double m = 4.0 / 3.0 * std::numbers::pi * a * a * a * s.model.material.density;
  const BondLaw law(s.model.contact, s.model.material, a, a);
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{} particles of {:g} nm in a droplet of {:g} nm, {:.2f} % solids, dry after {:g} s",
                              s.radius.size(), a * 1e9, R0 * 1e9, 100 * n * std::pow(a / R0, 3),
                              s.model.droplet.lifetime));
  lines.push_back(
      fmt::format("the front recedes at {:.2g} m/s, {:.2g} m/s when the solids are packed; capillary force moves a "
                  "particle at up to sigma/(3 mu) = {:.2g} m/s{}",
                  start_speed, packed_speed, limit,
                  packed_speed > limit ? ": the front overtakes particles, which are left dry" : ""));
  lines.push_back(fmt::format("largest capillary force {:.3g} N = {:.2g} of the pull-off force {:.3g} N",
                              capillary_force(sigma, a, 0), capillary_force(sigma, a, 0) / law.pull_off_force(),
                              law.pull_off_force()));
  lines.push_back(fmt::format("time scales: inertia {:.2g} s, contact {:.2g} s, drying {:.2g} s",
                              m / drag_coefficient(mu, a), drag_coefficient(mu, a) / law.normal_stiffness(),
                              s.model.droplet.lifetime));
  lines.push_back("Pe = infinity: without Brownian motion the front sweeps the particles into a shell");
  return lines;
}

}  // namespace crumble
