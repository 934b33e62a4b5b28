// How fast what bonds hold together relaxes: what limits explicit steps.
#pragma once

#include "dryer/bond_block.hpp"

namespace crumble::dryer {

// Mobilities of the particles of a motion block.
struct Mobility {
  std::vector<float> translation, rotation;  // 1/zeta, m/(N s); 1/zeta_r, rad/(N m s)

  void resize(std::size_t count);
  Six of(std::size_t place) const { return six(translation[place], rotation[place]); }
};

// Upper bound of the largest eigenvalue of mobility times stiffness, 1/s: from the largest Ritz value of so many steps
// of Lanczos from a random start, which is
//   below (1 - e) times the eigenvalue  with a probability of at most  1.648 sqrt(n) exp(-sqrt(e) (2 steps - 1))
// for a matrix of n rows. Source: Kuczynski & Wozniakowski 1992, Theorem 4.2. e is chosen such that this is 1e-9.
//
// Of the bonds as find_stiffness() last found them; what they have as loads is lost. On all threads; the same bits on
// any number of them. Two vectors are kept, whatever the number of steps; libraries keep all of them, more than the
// droplet itself needs.
double relaxation_rate(BondBlock& bonds, const Mobility& mobility);

// By how much the eigenvalues that belong to a place can have grown since stiffness was last remembered, 1/s, an upper
// bound: the largest eigenvalue of a sum is at most the sum of the largest ones (Weyl), and that of what has been added
// is found from its energy. The energy of a bond is a square of differences between its ends, and (x - y)^2 <= 2 x^2 +
// 2 y^2 makes a sum over particles of it: of the displacements with 2 k_n along the normal and 3.5 k_s across it, of
// the rotations with 3.5 k_s across it, too, rolling and twisting added (3.5 = 1 + 1 + 3/4 + 3/4, since zeta_r = 4/3
// a^2 zeta). Only a bound above `known` is made sharp; radius: of the place, m.
double rate_increase(const BondBlock& bonds, const Mobility& mobility, double radius, std::size_t place,
                     double known = 0);

}  // namespace crumble::dryer
