// The geometry-free part of the multipole mobility: which derivative of 1/|d| enters which pair of densities.
//
// Polynomials in the gradient k that act on harmonic functions count only modulo k^2. With the substitution
//   k_x + i k_y = s^2,   k_x - i k_y = -t^2,   k_z = s t      (so that k^2 = 0)
// a harmonic polynomial H_lm becomes the monomial s^(l+m) t^(l-m), which defines it here, products of harmonics
// multiply monomials, and the gradient acts as second derivatives in s and t:
//   d_z H_lm = (l+m)(l-m)/(2l-1) H_l-1,m,   (d_x - i d_y) H_lm = (l+m)(l+m-1)/(2l-1) H_l-1,m-1,
//   (d_x + i d_y) H_lm = -(l-m)(l-m-1)/(2l-1) H_l-1,m+1.
#pragma once

#include <vector>

#include "common/agglomerate/agglomerate.hpp"

namespace crumble::multipole {

enum class Family { W, X, V };

// One real density: the family of the real part (cosine) or imaginary part (sine) of H_jm, m >= 0.
struct Density {
  Family family;
  int j, m;
  bool sine;

  int degree() const { return family == Family::W ? j - 1 : family == Family::X ? j : j + 1; }
};

// Stresslets in the order of strain_basis.hpp, then all higher densities, then forces x, y, z and torques x, y, z.
std::vector<Density> densities(int order);

// Integral of the squared vector polynomial over the unit sphere.
double squared_norm(const Density& d);

// lambda of the single layer on the density's own sphere.
double eigenvalue(const Density& d);

// Derivatives J_LM = H_LM(grad) 1/|d| for L <= degree, 0 <= M <= L: real part at 2 (L (L + 1)/2 + M), imaginary part
// next.
constexpr int derivative_index(int L, int M) { return L * (L + 1) + 2 * M; }
void derivatives(int degree, const Vector3& d, double* J);

// Pair terms of `order`: entry (k, k') is the sum of value * V[index] over its terms. V holds the derivatives up to
// degree 2 (order + 1), followed for every pair (j, j') of family W by j j' (|d|^2/(2 (j+j') - 1) - a_i^2/(2j+1) -
// a_j^2/(2j'+1)) J_j+j',M.
struct PairTable {
  struct Term {
    int index;
    double value;
  };
  int order, unknowns;
  std::vector<int> first;  // of the terms of entry k' + k * unknowns
  std::vector<Term> terms;
  int values;  // length of V

  explicit PairTable(int order);
  void fill(const Vector3& d, double a_i, double a_j, std::vector<double>& V) const;
};

}  // namespace crumble::multipole
