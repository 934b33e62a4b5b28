// Where the contact laws hold: they are of contacts that are small against the particles.
#pragma once

#include <string>

#include "common/contact/material.hpp"

namespace crumble {

// b0/a of JKR's contact without load, which the theory takes for small (Johnson, Kendall & Roberts 1971: a half-space).
// At the limit two spheres overlap by (2/3) (b0/a)^2 = a quarter of the radius; beyond it particles reach into those
// behind their neighbours, and an agglomerate collapses into one place.
inline constexpr double largest_relative_contact = 0.6;
double relative_contact(const Material& material, double pair_radius);

// Of the smallest particles, m: a sentence with the numbers if the material is outside the theory, else nothing.
std::string outside_contact_theory(const Material& material, double smallest_radius);

}  // namespace crumble
