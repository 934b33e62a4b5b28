#include "common/contact/bond_law.hpp"

#include "common/contact/rolling.hpp"
#include "common/contact/sliding.hpp"
#include "common/contact/twisting.hpp"

namespace crumble {

BondLaw::BondLaw(const ContactChoice& choice, const Material& material, double radius_i, double radius_j)
    : kind(choice.normal), jkr(material, pair_radius(radius_i, radius_j)) {
  const double a = pair_radius(radius_i, radius_j);
  k_t = twisting_stiffness(material, a);
  k_r = choice.rolling_stiffness_factor * rolling_stiffness(material, a);
  M_t_crit = choice.twisting_limit_factor * twisting_limit(material, a);
  M_r_crit = choice.rolling_limit_factor * rolling_limit(material, a, jkr.zero_load_radius);
  F_s_crit = choice.sliding_limit_factor * crumble::sliding_limit(material, jkr.zero_load_radius);
  if (kind == NormalLaw::jkr) {
    k_s = sliding_stiffness(material, a);
  } else {
    linear.stiffness = choice.stiffness_factor * material.youngs_modulus * a;
    linear.pull_off_force = jkr.pull_off_force;
    linear.friction = choice.friction * choice.sliding_limit_factor;
    k_s = material.poisson_ratio * linear.stiffness;  // the ratio that the paper's code takes
  }
  if (choice.sliding_limit_factor == 0) k_s = 0;
  if (choice.twisting_limit_factor == 0) k_t = 0;
  if (choice.rolling_limit_factor == 0) k_r = 0;
}

double BondLaw::normal_energy(double gap) const {
  if (kind == NormalLaw::jkr) return jkr.energy(gap);
  const double h_po = linear.pull_off_gap();
  return gap < h_po ? 0.5 * linear.stiffness * gap * gap : 0.5 * linear.stiffness * h_po * h_po;
}

}  // namespace crumble
