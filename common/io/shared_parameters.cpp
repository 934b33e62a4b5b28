#include "common/io/shared_parameters.hpp"

#include "common/agglomerate/rescaled.hpp"

namespace crumble {

using P = Parameter;

std::vector<Parameter> agglomerate_parameters(std::vector<std::string> fragments, const std::string& meaning) {
  return {P::real("radius", "m", "Mean radius a to which the agglomerate is scaled; without it the file's own")
              .or_by("diameter", 0.5)
              .not_called("particle.size")
              .above(0)
              .optional(),
          P::choice("fragments", std::move(fragments), meaning).by_default("refuse").formerly("structure.fragments"),
          P::real("largest_gap", "", "A listed contact whose surfaces are farther apart is refused, in a")
              .above(0)
              .by_default(largest_listed_gap)
              .formerly("structure.largest_gap")};
}

Section material_section() {
  const Material table_1;
  return {"material",
          "What the particles are made of (paper, Table 1). A stage that takes an agglomerate has the file's values "
          "where the scene says nothing.",
          {P::real("youngs_modulus", "Pa", "Elastic modulus E").above(0).by_default(table_1.youngs_modulus),
           P::real("poisson_ratio", "", "Poisson ratio nu").above(-1).at_most(0.5).by_default(table_1.poisson_ratio),
           P::real("surface_energy", "J m-2", "Superficial energy gamma_s of one surface")
               .above(0)
               .not_called("contact.surface_energy")
               .not_called("particle.surface_energy")
               .by_default(table_1.surface_energy)}};
}

Parameter density_parameter() {
  return P::real("density", "kg m-3", "Density rho_p; matters to the inertial integrator only")
      .above(0)
      .not_called("particle.density")
      .by_default(Material{}.density);
}

Material material_in(const Scene& scene) {
  Material m{scene.real("material.youngs_modulus"), scene.real("material.poisson_ratio"),
             scene.real("material.surface_energy")};
  if (scene.declares("material.density")) m.density = scene.real("material.density");
  return m;
}

Parameter rolling_stiffness_parameter() {
  return P::real("rolling_stiffness_factor", "", "Of the rolling stiffness k_r (Eq. 20); the critical torque stays")
      .above(0)
      .by_default(ContactChoice{}.rolling_stiffness_factor)
      .formerly("structure.bending_factor");
}

Section contact_section() {
  const ContactChoice paper;
  return {
      "contact",
      "The bond between two touching particles. A limit factor multiplies the critical load of the paper's equation: "
      "0 takes the resistance away, 1e6 makes it elastic without limit in practice.",
      {P::real("sliding_limit_factor", "", "Of the critical sliding force (Eq. 14)")
           .at_least(0)
           .by_default(paper.sliding_limit_factor),
       P::real("twisting_limit_factor", "", "Of the critical twisting torque (Eq. 17)")
           .at_least(0)
           .by_default(paper.twisting_limit_factor),
       P::real("rolling_limit_factor", "", "Of the critical rolling torque (Eqs. 20-21)")
           .at_least(0)
           .by_default(paper.rolling_limit_factor),
       rolling_stiffness_parameter()}};
}

ContactChoice contact_in(const Scene& scene) {
  ContactChoice c;
  c.sliding_limit_factor = scene.real("contact.sliding_limit_factor");
  c.twisting_limit_factor = scene.real("contact.twisting_limit_factor");
  c.rolling_limit_factor = scene.real("contact.rolling_limit_factor");
  c.rolling_stiffness_factor = scene.real("contact.rolling_stiffness_factor");
  return c;
}

Parameter checkpoint_interval_parameter() {
  return P::real(
             "checkpoint_interval", "s",
             "Wall time from one checkpoint on the disk to the next, which is all that is lost if the run is killed; "
             "0: only when a signal stops it. Results do not depend on it")
      .at_least(0)
      .by_default(60);
}

Section fluid_section() {
  return {"fluid",
          "The liquid: in the droplet, and around the agglomerate.",
          {P::real("viscosity", "Pa s", "Viscosity mu").above(0).by_default(1e-3).formerly("liquid.viscosity")}};
}

Section loading_fluid_section() {
  Section section = fluid_section();
  section.parameters.push_back(
      P::real("density", "kg m-3", "Density rho of the liquid; only a dissipation rate in W/kg (--at) needs it")
          .above(0)
          .by_default(water_density));
  section.parameters.push_back(
      P::real("temperature", "K", "Temperature T of the liquid; only surface forces need it").above(0).by_default(300));
  return section;
}

Liquid liquid_in(const Scene& scene) { return {scene.real("fluid.viscosity"), scene.real("fluid.density")}; }

Section hydrodynamics_section(std::vector<std::string> methods, const char* by_default, const std::string& meaning) {
  return {"hydrodynamics",
          "How the spheres act on each other through the fluid.",
          {P::choice("method", std::move(methods), meaning).by_default(by_default),
           P::real("lubrication_range", "", "Lubrication: pairs of centres closer than this, in mean radii")
               .above(2)
               .by_default(HydroModel{}.lubrication_range),
           P::real("gap_floor", "",
                   "Lubrication: closer pairs, all contacts among them, are taken as at this gap, in a; their centres "
                   "are taken apart to it, so that rigid motion and uniform strain stay consistent")
               .above(1e-6)
               .at_most(0.1)
               .by_default(1e-3)}};
}

HydroModel lubrication_in(const Scene& scene, Rung rung) {
  HydroModel model{rung};
  model.lubrication_range = scene.real("hydrodynamics.lubrication_range");
  model.gap_floor = scene.real("hydrodynamics.gap_floor");
  return model;
}

}  // namespace crumble
