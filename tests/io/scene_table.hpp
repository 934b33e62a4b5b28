// A table like the dryer's, for the tests of reading and of malformed scenes.
#pragma once

#include "common/io/parameters.hpp"

namespace crumble::testing {

inline const ParameterTable& table() {
  static const ParameterTable t{
      {"particle",
       "The primary particles.",
       {Parameter::real("radius", "m", "Radius a").above(0).by_default(10e-9),
        Parameter::integer("number", "Number of particles; or give solids_fraction").at_least(1).optional(),
        Parameter::real("solids_fraction", "", "Volume of particles over volume of droplet")
            .above(0)
            .below(0.5)
            .optional(),
        Parameter::real("density", "kg m-3", "Density").above(0).by_default(1300)}},
      {"material",
       "Elasticity and adhesion.",
       {Parameter::real("poisson_ratio", "", "Poisson ratio").above(-1).at_most(0.5).by_default(0.5),
        Parameter::real("youngs_modulus", "Pa", "Modulus of elasticity").above(0).by_default(3.4e9)}},
      {"contact",
       "The contact between two particles.",
       {Parameter::choice("law", {"jkr", "cundall-strack"}, "Normal force").by_default("jkr"),
        Parameter::flag("rolling", "Resist rolling").by_default(true)}},
      {"droplet",
       "The liquid.",
       {Parameter::real("radius", "m", "Radius R0 at the start").above(0),
        Parameter::real("viscosity", "Pa s", "Viscosity").above(0).or_word({"water", "honey"}).by_default(1e-3)}},
      {"run",
       "The run itself.",
       {Parameter::integer("seed", "Names the random start").at_least(0).by_default(1),
        Parameter::integer("frames", "Frames in the file").at_least(2).at_most(10000).by_default(50),
        Parameter::text("title", "Free text").by_default("")}}};
  return t;
}

inline constexpr const char* good_scene = R"(# a droplet
[particle]
number = 115

[droplet]
radius = 215e-9
)";

}  // namespace crumble::testing
