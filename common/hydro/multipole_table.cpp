#include "common/hydro/multipole_table.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace crumble::multipole {

namespace {

using Complex = std::complex<double>;

void add(std::vector<Density>& list, Family family, int j) {
  // m = -j ... j: sines of falling m, then cosines of rising m.
  for (int m = j; m > 0; --m) list.push_back({family, j, m, true});
  for (int m = 0; m <= j; ++m) list.push_back({family, j, m, false});
}

void add_vector(std::vector<Density>& list, Family family) {  // x, y, z
  list.push_back({family, 1, 1, false});
  list.push_back({family, 1, 1, true});
  list.push_back({family, 1, 0, false});
}

double factorial(int n) { return std::tgamma(n + 1.0); }

// The real density's H_jm, H_j,-m content: coefficient and order m of each.
struct Part {
  Complex factor;
  int m;
};
std::vector<Part> parts(const Density& d) {
  if (d.m == 0) return {{1, 0}};
  const double sign = d.m % 2 == 0 ? 1 : -1;
  if (d.sine) return {{Complex(0, -0.5), d.m}, {Complex(0, 0.5 * sign), -d.m}};
  return {{0.5, d.m}, {0.5 * sign, -d.m}};
}

// grad H_jm . grad H_j'm' = g H_j+j'-2,m+m' modulo k^2.
double gradient_product(int j, int m, int jj, int mm) {
  const double p = j + m, q = j - m, pp = jj + mm, qq = jj - mm;
  return (p * q * pp * qq - 0.5 * q * (q - 1) * pp * (pp - 1) - 0.5 * p * (p - 1) * qq * (qq - 1)) /
         ((2 * j - 1) * (2 * jj - 1));
}

// grad H_jm . (k x grad H_j'm') = i g H_j+j'-1,m+m' modulo k^2.
double rotation_product(int j, int m, int jj, int mm) {
  const double p = j + m, q = j - m, pp = jj + mm, qq = jj - mm;
  return (p * q * mm + 0.5 * q * (q - 1) * pp - 0.5 * p * (p - 1) * qq) / (2 * j - 1);
}

int combined_index(int order, int j, int jj) {
  int index = derivative_index(2 * order + 3, 0);
  for (int a = 1; a <= order + 1; ++a)
    for (int b = 1; b <= order + 1; ++b) {
      if (a == j && b == jj) return index;
      index += 2 * (a + b + 1);
    }
  return index;
}

class Entry {
 public:
  // Adds the real part of factor * J_LM; J_L,-M = (-1)^M conj J_LM. `base` is the index of J_L0.
  void add(Complex factor, int base, int M) {
    if (factor == Complex(0)) return;
    const double sign = M < 0 && M % 2 != 0 ? -1 : 1, conjugate = M < 0 ? -1 : 1;
    put(base + 2 * std::abs(M), sign * factor.real());
    put(base + 2 * std::abs(M) + 1, -sign * conjugate * factor.imag());
  }
  const std::vector<PairTable::Term>& terms() const { return terms_; }

 private:
  std::vector<PairTable::Term> terms_;
  void put(int index, double value) {
    if (value == 0) return;
    for (auto& t : terms_)
      if (t.index == index) {
        t.value += value;
        return;
      }
    terms_.push_back({index, value});
  }
};

// With the Stokeslet G = (lap - grad grad)|d| and gamma = a_i^2/(2 (2j+1)) + a_j^2/(2 (2j'+1)), J = j + j', products of
// densities act as
//   W W'  j j' (|d|^2/(2J-1) - 2 gamma) J_J + 2 g (1 - j j'/(2J-1)) J_J-2    with g of gradient_product
//   W X'  2 i g J_J-1   with g of rotation_product (X W' likewise)
//   X X', W V', V W'    -2 j j' J_J
//   X V', V V'          nothing: G is divergence-free and biharmonic
Entry entry(int order, const Density& row, const Density& column) {
  Entry result;
  const int j = row.j, jj = column.j, J = j + jj;
  for (const Part& r : parts(row))
    for (const Part& c : parts(column)) {
      const Complex factor = r.factor * c.factor;
      const int M = r.m + c.m;
      if (row.family == Family::W && column.family == Family::W) {
        result.add(factor, combined_index(order, j, jj), M);
        if (std::abs(M) <= J - 2)
          result.add(factor * (2 * gradient_product(j, r.m, jj, c.m) * (1 - double(j * jj) / (2 * J - 1))),
                     derivative_index(J - 2, 0), M);
      } else if (row.family == Family::W && column.family == Family::X) {
        if (std::abs(M) <= J - 1)
          result.add(factor * Complex(0, 2 * rotation_product(j, r.m, jj, c.m)), derivative_index(J - 1, 0), M);
      } else if (row.family == Family::X && column.family == Family::W) {
        if (std::abs(M) <= J - 1)
          result.add(factor * Complex(0, 2 * rotation_product(jj, c.m, j, r.m)), derivative_index(J - 1, 0), M);
      } else if ((row.family == Family::X && column.family == Family::X) ||
                 (row.family == Family::W && column.family == Family::V) ||
                 (row.family == Family::V && column.family == Family::W)) {
        result.add(factor * (-2.0 * j * jj), derivative_index(J, 0), M);
      }
    }
  return result;
}

}  // namespace

std::vector<Density> densities(int order) {
  std::vector<Density> list;
  for (int j = 2; j <= order + 1; ++j) add(list, Family::W, j);
  for (int j = 2; j <= order; ++j) add(list, Family::X, j);
  for (int j = 1; j <= order - 1; ++j) add(list, Family::V, j);
  add_vector(list, Family::W);
  add_vector(list, Family::X);
  return list;
}

// int |H_lm|^2 = 4 pi 4^l l!^2 (l+m)! (l-m)!/((2l+1)! (2l)!); half of it for a real or imaginary part.
double squared_norm(const Density& d) {
  const int l = d.j;
  const double H = 4 * std::numbers::pi * std::pow(4.0, l) * factorial(l) * factorial(l) / factorial(2 * l + 1) *
                   (factorial(l + d.m) * factorial(l - d.m) / factorial(2 * l)) * (d.m == 0 ? 1 : 0.5);
  switch (d.family) {
    case Family::W:
      return l * (2 * l + 1) * H;
    case Family::X:
      return l * (l + 1) * H;
    case Family::V:
      break;
  }
  return (2 * l + 1) * (l + 1) * H;
}

double eigenvalue(const Density& d) {
  const double j = d.j;
  switch (d.family) {
    case Family::W:
      return (j + 1) / ((2 * j + 1) * (2 * j - 1));
    case Family::X:
      return 1 / (2 * j + 1);
    case Family::V:
      break;
  }
  return j / ((2 * j + 1) * (2 * j + 3));
}

// J_MM = -(2M - 1) (x + iy)/r^2 J_M-1,M-1;  r^2 J_L+1,M = -(2L + 1) z J_LM - (L^2 - M^2) J_L-1,M.
void derivatives(int degree, const Vector3& d, double* J) {
  const double inverse2 = 1 / d.squaredNorm(), x = d.x() * inverse2, y = d.y() * inverse2, z = d.z() * inverse2;
  double real = std::sqrt(inverse2), imaginary = 0;
  for (int M = 0; M <= degree; ++M) {
    if (M > 0) {
      const double factor = -(2 * M - 1), old = real;
      real = factor * (x * old - y * imaginary);
      imaginary = factor * (y * old + x * imaginary);
    }
    for (int part = 0; part < 2; ++part) {
      double current = part == 0 ? real : imaginary, before = 0;
      J[derivative_index(M, M) + part] = current;
      for (int L = M; L < degree; ++L) {
        const double next = -(2 * L + 1) * z * current - (L * L - M * M) * inverse2 * before;
        before = current;
        current = next;
        J[derivative_index(L + 1, M) + part] = current;
      }
    }
  }
}

PairTable::PairTable(int order_in) : order(order_in) {
  const std::vector<Density> list = densities(order);
  unknowns = static_cast<int>(list.size());
  values = combined_index(order, order + 1, order + 1) + 2 * (2 * order + 3);
  first.push_back(0);
  for (const Density& row : list)
    for (const Density& column : list) {
      const Entry e = entry(order, row, column);
      terms.insert(terms.end(), e.terms().begin(), e.terms().end());
      first.push_back(static_cast<int>(terms.size()));
    }
}

void PairTable::fill(const Vector3& d, double a_i, double a_j, std::vector<double>& V) const {
  V.resize(static_cast<std::size_t>(values));
  derivatives(2 * order + 2, d, V.data());
  double* combined = V.data() + combined_index(order, 1, 1);
  for (int j = 1; j <= order + 1; ++j)
    for (int jj = 1; jj <= order + 1; ++jj) {
      const int J = j + jj;
      const double factor =
          j * jj * (d.squaredNorm() / (2 * J - 1) - a_i * a_i / (2 * j + 1) - a_j * a_j / (2 * jj + 1));
      const double* source = V.data() + derivative_index(J, 0);
      for (int k = 0; k < 2 * (J + 1); ++k) *combined++ = factor * source[k];
    }
}

}  // namespace crumble::multipole
