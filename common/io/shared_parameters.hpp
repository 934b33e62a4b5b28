// The parts of a scene that several programs have, each declared once, with the function that reads it. Defaults are
// those of the structs that they fill.
#pragma once

#include "common/contact/bond_law.hpp"
#include "common/hydro/model.hpp"
#include "common/io/parameters.hpp"
#include "common/io/service_load.hpp"

namespace crumble {

// [particle] of the stages that take an agglomerate: radius, fragments (refuse, largest and what else the stage can
// do), largest_gap. `meaning` is that of `fragments`.
std::vector<Parameter> agglomerate_parameters(std::vector<std::string> fragments, const std::string& meaning);

// [material]; the density only where something depends on it.
Section material_section();
Parameter density_parameter();
Material material_in(const Scene& scene);

// [contact]: limits and stiffness of the bond.
Section contact_section();
Parameter rolling_stiffness_parameter();
ContactChoice contact_in(const Scene& scene);

// [output]: how often a run saves its state, s.
Parameter checkpoint_interval_parameter();

// [fluid]: the liquid in the droplet, or around the agglomerate.
inline constexpr double water_density = 997;  // at 25 C, kg/m^3
Section fluid_section();
// Of a liquid that loads granules: its density, too.
Section loading_fluid_section();
Liquid liquid_in(const Scene& scene);

// [hydrodynamics]; `methods` and their meaning are the stage's, the rest belongs to pair lubrication.
Section hydrodynamics_section(std::vector<std::string> methods, const char* by_default, const std::string& meaning);
// Range and floor of lubrication; the rung is the stage's to say.
HydroModel lubrication_in(const Scene& scene, Rung rung);

}  // namespace crumble
