#include "common/contact/small_contact.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/contact/jkr.hpp"

namespace crumble {

double relative_contact(const Material& material, double pair_radius) {
  return Jkr(material, pair_radius).zero_load_radius / pair_radius;
}

std::string outside_contact_theory(const Material& material, double smallest_radius) {
  const double found = relative_contact(material, smallest_radius);
  if (found <= largest_relative_contact) return "";
  // b0/a goes with E^(-1/3).
  const double modulus = material.youngs_modulus * std::pow(found / largest_relative_contact, 3);
  return fmt::format(
      "makes contacts of b0 = {:.3g} a between particles of a = {:g} m, and JKR's theory is of small ones, up to {:g} "
      "a: "
      "with this surface energy a modulus of at least {:.2g} Pa is needed (the default is 3.4e9 Pa; were GPa meant?)",
      found, smallest_radius, largest_relative_contact, modulus);
}

}  // namespace crumble
