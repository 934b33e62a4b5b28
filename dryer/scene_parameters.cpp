// The keys of a drying scene.
#include "common/io/shared_parameters.hpp"
#include "common/io/surface_forces_parameters.hpp"
#include "dryer/gas/gas_side.hpp"
#include "dryer/scene.hpp"

namespace crumble::dryer {

using P = Parameter;

namespace {

Section material() {
  Section section = material_section();
  section.parameters.push_back(density_parameter());
  return section;
}

// The liquid of a droplet has a temperature and a surface, too.
Section fluid() {
  Section section = fluid_section();
  section.meaning +=
      " Water's viscosity is that of IAPWS R12-08 at 0.1 MPa, its surface tension that of IAPWS R1-76, both at "
      "fluid.temperature.";
  auto& keys = section.parameters;
  keys.front() = keys.front().or_word({"water"});
  keys.insert(keys.begin(), P::real("temperature", "K", "Temperature T of liquid and particles, uniform")
                                .above(0)
                                .by_default(300)
                                .formerly("liquid.temperature"));
  keys.push_back(P::real("density", "kg m-3", "Density of the liquid; only particle.weight_fraction needs it")
                     .above(0)
                     .by_default(water_density));
  keys.push_back(
      P::real("surface_tension", "N m-1",
              "Surface tension sigma. The default is the paper's reduced value; water's is 400 times as large")
          .at_least(0)
          .or_word({"water"})
          .by_default(1.75e-4)
          .formerly("liquid.surface_tension"));
  keys.push_back(P::real("contact_angle", "degree",
                         "Contact angle theta of the liquid on the particles: the capillary force of Eq. 8 times "
                         "cos^2(theta/2)")
                     .at_least(0)
                     .below(180)
                     .by_default(0)
                     .formerly("liquid.contact_angle"));
  return section;
}

Section contact() {
  const ContactChoice paper;
  Section section = contact_section();
  const std::vector<Parameter> law{
      P::choice("law", {"jkr", "cundall-strack"},
                "Normal force: JKR (Eq. 10), or a linear spring with the pull-off force of Eq. 6 and Coulomb friction")
          .by_default("jkr"),
      P::real("stiffness_factor", "", "cundall-strack: spring stiffness in units of E a")
          .above(0)
          .by_default(paper.stiffness_factor),
      P::real("friction", "", "cundall-strack: tangent of the friction angle; it limits sliding instead of Eq. 14")
          .at_least(0)
          .by_default(paper.friction)};
  section.parameters.insert(section.parameters.begin(), law.begin(), law.end());
  return section;
}

}  // namespace

const ParameterTable& drying_parameters() {
  static const ParameterTable table{
      {"particle",
       "The primary particles: spheres, equal unless particle.distribution says otherwise.",
       {P::real("radius", "m", "Radius a; lognormal: the median; bimodal: of the first kind")
            .or_by("diameter", 0.5)
            .not_called("particle.size")
            .above(0),
        P::choice("distribution", {"equal", "lognormal", "bimodal"},
                  "Of the radii by number. lognormal: within three standard deviations of ln a")
            .by_default("equal"),
        P::real("geometric_standard_deviation", "", "lognormal: sigma_g, exp of the standard deviation of ln a")
            .above(1)
            .at_most(2)
            .optional(),
        P::real("second_radius", "m", "bimodal: radius of the second kind").above(0).optional(),
        P::real("second_share", "", "bimodal: share of the second kind by number").above(0).below(1).optional(),
        P::integer("number", "How many, N; or particle.solids_fraction or particle.weight_fraction")
            .at_least(1)
            .at_most(2147483647)
            .optional(),
        P::real("solids_fraction", "",
                "Volume of the particles in that of the droplet at the start: N = fraction (R0/a)^3, rounded; of "
                "distributed radii as many as come nearest to it")
            .or_by("volume_fraction", 1)
            .above(0)
            .below(1)
            .optional(),
        P::real(
            "weight_fraction", "",
            "Weight of the particles in that of the droplet at the start; needs material.density, and fluid.density "
            "of the liquid")
            .or_by("mass_fraction", 1)
            .or_by("weight_percent", 0.01)
            .above(0)
            .below(1)
            .optional(),
        P::flag("brownian_motion",
                "Brownian force and torque (Eqs. 4-5) at fluid.temperature; false: D = 0, Pe = infinity")
            .by_default(false)}},
      material(),
      fluid(),
      {"droplet",
       "The droplet: R(t)^2 = R0^2 - k t (Eq. 7). How fast it dries is said by exactly one of lifetime, "
       "evaporation_constant, "
       "front_speed and peclet, or follows from [gas].",
       {P::real("radius", "m", "Radius R0 at the start").or_by("diameter", 0.5).not_called("droplet.size").above(0),
        P::real("lifetime", "s", "Time tau = R0^2/k at which the liquid is gone")
            .not_called("droplet.drying_time")
            .above(0)
            .optional(),
        P::real("evaporation_constant", "m2 s-1",
                "Evaporation constant k of the radius squared. Tables often hold that of the diameter squared, 4 k")
            .or_by("diameter_evaporation_constant", 0.25)
            .above(0)
            .optional(),
        P::real("front_speed", "m s-1", "Speed -dR/dt = k/(2 R0) of the surface at the start").above(0).optional(),
        P::real("peclet", "", "Peclet number Pe = R0^2/(D tau) = k/D (Eq. 22), D of Eq. 23").above(0).optional(),
        initial_temperature_parameter()}},
      gas_section(),
      contact(),
      surface_forces_section(),
      {"dry",
       "A particle that the liquid has left behind (r > R + a). No capillary force acts on it; its bonds stay.",
       {P::flag("everything_acts", "Thermal noise goes on as in the liquid").by_default(false),
        P::real("drag_factor", "", "Of Stokes drag, which stays as a relaxation; the manual says what it changes")
            .above(0)
            .by_default(1)}},
      {"crust",
       "The dry crust hinders the vapour on its way out: the second stage of drying, longer than droplet.lifetime.",
       {P::real("relative_diffusivity", "",
                "Of vapour in the pores of the crust, in that in the gas (porosity over tortuosity); 1: no hindrance")
            .above(0)
            .at_most(1)
            .by_default(1)}},
      {"integrator",
       "How the equations are solved.",
       {P::choice("method", {"overdamped", "stabilised", "implicit", "two-rate", "inertial"},
                  "overdamped: no inertia; stabilised, or implicit where the contact law is not jkr, or two-rate where "
                  "Brownian motion breaks bonds; these can be asked for by name; inertial: the paper's scheme, fixed "
                  "step, slow")
            .by_default("overdamped"),
        P::real("largest_displacement", "", "implicit and stabilised: largest motion of a particle in one step, in a")
            .above(0)
            .at_most(0.2)
            .by_default(usual_displacement),
        P::real("brownian_displacement", "",
                "stabilised with Brownian motion: root mean square displacement of a free particle while its random "
                "force stands, in a; with surface forces by default at most a quarter of the Debye length at the start")
            .above(0)
            .at_most(0.2)
            .by_default(StabilisedControl{}.brownian_displacement),
        P::real("contact_precision", "",
                "implicit: overlap beyond which a pair is bonded within the step in which it touches, in a")
            .above(0)
            .at_most(1e-2)
            .by_default(ImplicitControl{}.contact_precision),
        P::real("contact_step", "",
                "two-rate: the short step of particles in touch, in the relaxation time "
                "6 pi mu a/k_n of a contact")
            .above(0)
            .at_most(0.15)
            .by_default(BrownianControl{}.contact_step),
        P::real("softening", "",
                "two-rate: width of the bond in the packed liquid core in that of the material's; "
                "its strength is such that pairs stay together as much. What dries has the material's. 1: full "
                "stiffness throughout")
            .at_least(1)
            .at_most(4)
            .by_default(1.5),
        P::real("step", "s", "inertial: the fixed step; without it a fifth of the time scale of the stiffest contact")
            .above(0)
            .optional()}},
      {"stands_for",
       "The real droplet for which this smaller one stands; `dryer SCENE.toml --fit-to` writes it. The report then "
       "says "
       "what is known of the real granule.",
       {P::real("number", "", "Particles in it").at_least(1).optional(), real_radius_parameter()}},
      {"error",
       "How the run judges itself.",
       {P::flag("estimate",
                "D = 0: also run with doubled step control (three quarters as long again) and report the difference")
            .by_default(true)}},
      {"output",
       "What the file holds.",
       {P::integer("frames", "Frames between start and end, evenly spaced in the radius of the droplet")
            .at_least(0)
            .at_most(100000)
            .by_default(50),
        P::list("theta", "", "Further frames: [0.2, 0.4] adds those where (R/R0)^2 has fallen by 0.2 and by 0.4")
            .above(0)
            .below(1)
            .optional(),
        checkpoint_interval_parameter()}},
      {"run", "The run itself.", {P::integer("seed", "Names the random start").at_least(0).by_default(1)}}};
  return table;
}

}  // namespace crumble::dryer
