#include "common/hydro/two_sphere_series.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "common/hydro/two_sphere_real.hpp"

namespace crumble {

using namespace two_sphere;

namespace {

using Row = std::vector<Real>;

// The pair in bispherical coordinates: sphere 1 at zeta = -zeta[0], sphere 2 at zeta = +zeta[1], focal distance c;
// lengths in the mean radius. center is the z of the centres.
struct Bispherical {
  Real c, zeta[2], radius[2], center[2];
  int terms;  // highest degree n
};

Bispherical bispherical(Real xi, Real lambda) {
  Bispherical g;
  g.radius[0] = 2 / (1 + lambda);
  g.radius[1] = 2 * lambda / (1 + lambda);
  const Real r = 2 + xi, a1 = g.radius[0], a2 = g.radius[1];
  // 4 r^2 c^2 = (r^2 - a1^2 - a2^2)^2 - 4 a1^2 a2^2, factored so that a small gap keeps its digits.
  const Real difference = a1 - a2;
  g.c = real_sqrt(xi * (r + 2) * (r - difference) * (r + difference)) / (2 * r);
  for (int s = 0; s < 2; ++s) {
    const Real sinh = g.c / g.radius[s];
    g.zeta[s] = real_log1p(sinh + sinh * sinh / (1 + real_sqrt(1 + sinh * sinh)));
    g.center[s] = (s == 0 ? -1 : 1) * real_sqrt(g.c * g.c + g.radius[s] * g.radius[s]);
  }
  // Every sum converges as a low power of n zeta times exp(-2 n zeta); 17 digits at least.
  g.terms = 20 + static_cast<int>(28 / std::min(static_cast<double>(g.zeta[0]), static_cast<double>(g.zeta[1])));
  return g;
}

// Square band matrix of half-bandwidth `half`, solved by elimination with partial pivoting for several right sides.
class Band {
 public:
  static constexpr int half = 5, width = 3 * half + 1;
  explicit Band(int size) : size_(size), entry_(static_cast<std::size_t>(size) * width) {}
  Real& operator()(int row, int column) {
    return entry_[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column - row + half)];
  }
  void solve(std::vector<Row>& right);

 private:
  int size_;
  std::vector<Real> entry_;
};

void Band::solve(std::vector<Row>& right) {
  const auto magnitude = [](Real x) { return x < 0 ? -x : x; };
  for (int k = 0; k < size_; ++k) {
    const int last_row = std::min(size_ - 1, k + half), last_column = std::min(size_ - 1, k + 2 * half);
    int pivot = k;
    for (int i = k + 1; i <= last_row; ++i)
      if (magnitude((*this)(i, k)) > magnitude((*this)(pivot, k))) pivot = i;
    if ((*this)(pivot, k) == 0) throw std::runtime_error("two_sphere_series: singular continuity system");
    if (pivot != k) {
      for (int j = k; j <= last_column; ++j) std::swap((*this)(k, j), (*this)(pivot, j));
      for (Row& b : right) std::swap(b[k], b[pivot]);
    }
    for (int i = k + 1; i <= last_row; ++i) {
      const Real factor = (*this)(i, k) / (*this)(k, k);
      if (factor == 0) continue;
      for (int j = k + 1; j <= last_column; ++j) (*this)(i, j) -= factor * (*this)(k, j);
      for (Row& b : right) b[i] -= factor * b[k];
    }
  }
  for (int k = size_ - 1; k >= 0; --k) {
    const int last_column = std::min(size_ - 1, k + 2 * half);
    for (Row& b : right) {
      for (int j = k + 1; j <= last_column; ++j) b[k] -= (*this)(k, j) * b[j];
      b[k] /= (*this)(k, k);
    }
  }
}

// Values on the two spheres, as coefficients of sqrt(cosh zeta - mu) P_n^k(mu), index n = 0 ... terms + 2.
struct OnSpheres {
  Row value[2];
};

// Linear dependence of one sphere's coefficient of degree n on its unknowns w_{n-1}, w_n, w_{n+1}.
struct Stencil {
  Real below = 0, at = 0, above = 0;
};

// Loads on both spheres (on the fluid), in units of mu and the mean radius: force, torque, stresslet component.
struct Loads {
  Real force[2] = {0, 0}, torque[2] = {0, 0}, stresslet[2] = {0, 0};
};

// What a motion of one sphere prescribes on it: u_z and the combination d = u_rho - u_phi (m >= 1, harmonic of order
// m-1) or u_rho (m = 0, order 1); u_rho + u_phi vanishes in every case used. Coefficients of 1, z - z_center and rho.
struct Motion {
  int sphere;
  Real z_const = 0, z_axial = 0, z_rho = 0, d_const = 0, d_axial = 0, d_rho = 0;
};

class AzimuthalOrder {
 public:
  AzimuthalOrder(const Bispherical& geometry, int order) : g_(geometry), m_(order) {
    for (int s = 0; s < 2; ++s) {
      sinh_[s] = (s == 0 ? -1 : 1) * g_.c / g_.radius[s];
      cosh_[s] = real_sqrt(1 + sinh_[s] * sinh_[s]);
    }
    const int size = g_.terms + 4;
    for (int s = 0; s < 2; ++s) decay_[s].resize(size);
    overlap_.resize(size);
    inverse_.resize(size);
    for (int n = 0; n < size; ++n) {
      const Real nu = n + Real(1) / 2, both = g_.zeta[0] + g_.zeta[1];
      for (int s = 0; s < 2; ++s) decay_[s][n] = real_exp(-nu * g_.zeta[s]);
      overlap_[n] = real_exp(-nu * both);
      inverse_[n] = -1 / real_expm1(-2 * nu * both);
    }
  }
  std::vector<Loads> solve(const std::vector<Motion>& motions) const;
  Loads axial_rotation(int sphere) const;

 private:
  // No-slip on sphere s: coefficients of Q, U2, U0 in terms of w = (W - u_z).
  Stencil pressure(int s, int n) const;
  Stencil up(int s, int n) const;
  Stencil down(int s, int n) const;
  // Continuity of family f (0: sources in sphere 1, 1: in sphere 2), equation n, for contributions of degree n + shift.
  struct Weights {
    Real q, u2, u0, w;
  };
  Weights continuity(int f, int n, int shift) const;
  // Split into families: coefficient of family f = inverse * (own sphere's value - overlap * other sphere's value).
  Real family(int n, const Row& own, const Row& other) const { return inverse_[n] * (own[n] - overlap_[n] * other[n]); }
  Row prescribed(const Motion& motion, int part) const;
  Loads loads(const OnSpheres& q, const OnSpheres& w) const;

  const Bispherical& g_;
  int m_;
  Real sinh_[2], cosh_[2];
  Row decay_[2], overlap_, inverse_;
};

Stencil AzimuthalOrder::pressure(int s, int n) const {
  if (n < m_) return {};
  const Real f = -2 / sinh_[s];
  return {-f * (n - m_) / (2 * n - 1), f * cosh_[s], -f * (n + m_ + 1) / (2 * n + 3)};
}

Stencil AzimuthalOrder::up(int s, int n) const {
  if (n < m_ + 1) return {};
  const Real f = 1 / sinh_[s];
  return {f / (2 * n - 1), 0, -f / (2 * n + 3)};
}

Stencil AzimuthalOrder::down(int s, int n) const {
  if (m_ == 0 || n < m_ - 1) return {};
  const Real f = 1 / sinh_[s];
  return {-f * (n - m_) * (n - m_ + 1) / (2 * n - 1), 0, f * (n + 1 + m_) * (n + m_) / (2 * n + 3)};
}

AzimuthalOrder::Weights AzimuthalOrder::continuity(int f, int n, int shift) const {
  const int m = m_;
  const Real sign = f == 1 ? 1 : -1, twice = m == 0 ? 2 : 1, none = m == 0 ? 0 : 1;
  const Real nm = n - m, np = n + m + 1;
  if (shift == 0) return {5, -2 * twice * np * nm, 2 * none, sign * 2 * (2 * n + 1)};
  if (shift < 0) return {-nm, twice * (nm - 1) * nm, -none, -sign * 2 * nm};
  return {np, twice * (np + 1) * np, -none, -sign * 2 * np};
}

// part 0: u_z (order m); part 1: d (order m-1, or 1 when m = 0).
Row AzimuthalOrder::prescribed(const Motion& motion, int part) const {
  const int s = motion.sphere;
  const Real root2 = real_sqrt(Real(2)), side = s == 0 ? -1 : 1;
  Row value(decay_[s].size(), Real(0));
  const Real constant = part == 0 ? motion.z_const : motion.d_const;
  const Real axial = part == 0 ? motion.z_axial : motion.d_axial;
  const Real rho = part == 0 ? motion.z_rho : motion.d_rho;
  for (int n = 0; n < static_cast<int>(value.size()); ++n) {
    const Real z = side * g_.c * (2 * n + 1) - g_.center[s];
    value[n] = root2 * decay_[s][n] * (constant + axial * z + (n > 0 ? 2 * g_.c * rho : Real(0)));
  }
  return value;
}

std::vector<Loads> AzimuthalOrder::solve(const std::vector<Motion>& motions) const {
  const int first = m_, last = g_.terms, count = last - first + 1;
  const auto index = [first](int n, int s) { return 2 * (n - first) + s; };
  Band matrix(2 * count);
  std::vector<Row> right(motions.size(), Row(2 * count, Real(0)));
  std::vector<Row> z_data, d_data;
  for (const Motion& motion : motions) {
    z_data.push_back(prescribed(motion, 0));
    d_data.push_back(prescribed(motion, 1));
  }
  struct NoSlip {
    Stencil q, u2, u0;
  };
  std::vector<NoSlip> slip[2];
  Real step[2][3];
  for (int s = 0; s < 2; ++s) {
    for (int shift = -1; shift <= 1; ++shift) step[s][shift + 1] = real_exp(-shift * g_.zeta[s]);
    for (int k = 0; k <= last + 1; ++k) slip[s].push_back({pressure(s, k), up(s, k), down(s, k)});
  }
  for (int n = first; n <= last; ++n)
    for (int f = 0; f < 2; ++f) {
      const int row = index(n, f);
      for (int shift = -1; shift <= 1; ++shift) {
        const int k = n + shift;
        if (k < 0) continue;
        const Weights c = continuity(f, n, shift);
        // Equation n is scaled by exp((n+1/2) zeta_f), the family's coefficients by their size on its own sphere.
        const Real scale = step[f][shift + 1] * inverse_[k];
        for (int s = 0; s < 2; ++s) {
          const Real split = s == f ? scale : -scale * overlap_[k];
          const Stencil &p = slip[s][k].q, &u = slip[s][k].u2, &v = slip[s][k].u0;
          const Real on_w[3] = {c.q * p.below + c.u2 * u.below + c.u0 * v.below,
                                c.q * p.at + c.u2 * u.at + c.u0 * v.at + (k >= m_ ? c.w : Real(0)),
                                c.q * p.above + c.u2 * u.above + c.u0 * v.above};
          for (int d = -1; d <= 1; ++d)
            if (k + d >= first && k + d <= last) matrix(row, index(k + d, s)) += split * on_w[d + 1];
          for (std::size_t r = 0; r < motions.size(); ++r) {
            if (motions[r].sphere != s) continue;
            if (k >= m_) right[r][row] -= split * c.w * z_data[r][k];
            if (m_ == 0 ? k >= 1 : k >= m_ - 1) right[r][row] -= split * (m_ == 0 ? c.u2 : c.u0) * d_data[r][k];
          }
        }
      }
    }
  matrix.solve(right);
  std::vector<Loads> result;
  for (std::size_t r = 0; r < motions.size(); ++r) {
    OnSpheres q, w;
    for (int s = 0; s < 2; ++s) {
      q.value[s].assign(decay_[s].size(), Real(0));
      w.value[s].assign(decay_[s].size(), Real(0));
      const auto unknown = [&](int n) { return n < first || n > last ? Real(0) : right[r][index(n, s)]; };
      for (int n = first; n <= last; ++n) {
        const Stencil p = pressure(s, n);
        q.value[s][n] = p.below * unknown(n - 1) + p.at * unknown(n) + p.above * unknown(n + 1);
        w.value[s][n] = unknown(n) + (motions[r].sphere == s ? z_data[r][n] : Real(0));
      }
    }
    result.push_back(loads(q, w));
  }
  return result;
}

// Moments of sqrt(cosh zeta - mu) exp(+(n+1/2) zeta) P_n^m about the origin, from its expansion at infinity along the
// axis: sqrt(2) c^(l+1) times a polynomial in n; the other family has the sign (-1)^(l-m).
Loads AzimuthalOrder::loads(const OnSpheres& q, const OnSpheres& w) const {
  Loads result;
  const Real root2 = real_sqrt(Real(2)), pi4 = 4 * real_pi();
  const Real c = g_.c;
  for (int s = 0; s < 2; ++s) {
    const Real side = s == 0 ? -1 : 1;
    Real dipole = 0, quadrupole = 0, w_dipole = 0;
    for (int n = g_.terms; n >= m_; --n) {
      const Real a = decay_[s][n] * family(n, q.value[s], q.value[1 - s]) / c;
      const Real N = Real(n) * (n + 1);
      if (m_ == 0) {
        dipole += a * side * (2 * n + 1);
        quadrupole += a * (2 * N + 1);
      } else if (m_ == 1) {
        dipole += a * N;
        quadrupole += a * side * N * (2 * n + 1) / 3;
        w_dipole += decay_[s][n] * family(n, w.value[s], w.value[1 - s]) * N;
      } else {
        quadrupole += a * N * (N - 2) / 6;
      }
    }
    dipole *= root2 * c * c;
    w_dipole *= root2 * c * c;
    quadrupole *= root2 * c * c * c;
    const Real z = g_.center[s];
    if (m_ == 0) {
      result.force[s] = pi4 * dipole;
      result.stresslet[s] = pi4 / 2 * (quadrupole - 2 * z * dipole);
    } else if (m_ == 1) {
      result.force[s] = pi4 * dipole;
      result.stresslet[s] = pi4 / 2 * (quadrupole - z * dipole);
      result.torque[s] = -2 * pi4 * (w_dipole + z * dipole / 2);
    } else {
      result.stresslet[s] = pi4 * quadrupole;
    }
  }
  return result;
}

// Rotation of one sphere about the line of centres: u_phi alone, harmonic of order 1.
Loads AzimuthalOrder::axial_rotation(int sphere) const {
  Loads result;
  const Real root2 = real_sqrt(Real(2)), pi8 = 8 * real_pi();
  for (int s = 0; s < 2; ++s) {
    Real sum = 0;
    for (int n = g_.terms; n >= 1; --n) {
      const Real value = 2 * root2 * g_.c * decay_[sphere][n];
      sum += decay_[s][n] * inverse_[n] * (s == sphere ? value : -overlap_[n] * value) * Real(n) * (n + 1);
    }
    result.torque[s] = pi8 * root2 * g_.c * g_.c * sum;
  }
  return result;
}

// Normalised scalars of both orderings: index [load sphere][moving sphere].
struct AllScalars {
  Real XA[2][2], YA[2][2], YB[2][2], XC[2][2], YC[2][2], XG[2][2], YG[2][2], YH[2][2], XM[2][2], YM[2][2], ZM[2][2];
  Real mirror_XG[2][2], mirror_YB[2][2], mirror_YG[2][2], mirror_YH[2][2];  // forces and torques of strain and rotation
};

AllScalars solve_all(const Bispherical& g) {
  AllScalars f;
  const AzimuthalOrder axial(g, 0), transverse(g, 1), plane(g, 2);
  std::vector<Motion> m0, m1, m2;
  for (int s = 0; s < 2; ++s) {
    m0.push_back({.sphere = s, .z_const = 1});
    m0.push_back({.sphere = s, .z_axial = Real(2) / 3, .d_rho = -Real(1) / 3});
    m1.push_back({.sphere = s, .d_const = 2});
    m1.push_back({.sphere = s, .z_rho = -1, .d_axial = 2});
    m1.push_back({.sphere = s, .z_rho = 1, .d_axial = 2});
    m2.push_back({.sphere = s, .d_rho = 2});
  }
  const auto l0 = axial.solve(m0), l1 = transverse.solve(m1), l2 = plane.solve(m2);
  const Real unit = 6 * real_pi();
  for (int b = 0; b < 2; ++b) {
    const Loads spin = axial.axial_rotation(b);
    for (int a = 0; a < 2; ++a) {
      f.XA[a][b] = l0[2 * b].force[a] / unit;
      f.XG[a][b] = l0[2 * b].stresslet[a] / unit;
      f.mirror_XG[b][a] = l0[2 * b + 1].force[a] / unit * 3 / 2;
      f.XM[a][b] = l0[2 * b + 1].stresslet[a] / unit;
      f.XC[a][b] = spin.torque[a] / unit;
      f.YA[a][b] = l1[3 * b].force[a] / unit;
      f.YB[a][b] = -l1[3 * b].torque[a] / unit;
      f.YG[a][b] = l1[3 * b].stresslet[a] / unit;
      f.mirror_YB[b][a] = -l1[3 * b + 1].force[a] / unit;
      f.YC[a][b] = l1[3 * b + 1].torque[a] / unit;
      f.YH[a][b] = l1[3 * b + 1].stresslet[a] / unit;
      f.mirror_YG[b][a] = l1[3 * b + 2].force[a] / unit / 2;
      f.mirror_YH[b][a] = l1[3 * b + 2].torque[a] / unit / 2;
      f.YM[a][b] = l1[3 * b + 2].stresslet[a] / unit;
      f.ZM[a][b] = l2[b].stresslet[a] / unit;
    }
  }
  return f;
}

// Largest difference between a scalar and its reciprocal partner, relative to max(|f|, self value of the smaller).
Real reciprocal_violation(const AllScalars& f, Real radius) {
  Real worst = 0;
  const auto compare = [&](const Real& x, const Real& y, int power) {
    Real self = 1;
    for (int k = 0; k < power; ++k) self *= radius;
    const Real scale = std::max({x, -x, y, -y, self}), difference = x > y ? x - y : y - x;
    worst = std::max(worst, difference / scale);
  };
  for (const auto* scalar : {&f.XA, &f.YA}) compare((*scalar)[0][1], (*scalar)[1][0], 1);
  for (const auto* scalar : {&f.XC, &f.YC, &f.XM, &f.YM, &f.ZM}) compare((*scalar)[0][1], (*scalar)[1][0], 3);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      compare(f.XG[i][j], f.mirror_XG[i][j], 2);
      compare(f.YB[i][j], f.mirror_YB[i][j], 2);
      compare(f.YG[i][j], f.mirror_YG[i][j], 2);
      compare(f.YH[i][j], f.mirror_YH[i][j], 3);
    }
  return worst;
}

}  // namespace

PairSeries two_sphere_series_pair(Real xi, Real lambda, double* asymmetry) {
  if (!(xi > 0) || !(lambda > 0))
    throw std::invalid_argument("two_sphere_series: gap and radius ratio must be positive");
  const Bispherical g = bispherical(xi, lambda);
  const AllScalars f = solve_all(g);
  if (asymmetry) *asymmetry = static_cast<double>(reciprocal_violation(f, std::min(g.radius[0], g.radius[1])));
  // Seen from sphere 2 the axis points the other way, which turns the sign of the scalars of odd parity.
  const auto of = [&f](int a, int b, int odd) {
    return std::array<Real, ResistanceScalars::count>{
        f.XA[a][a],       f.XA[a][b],       f.YA[a][a], f.YA[a][b], odd * f.YB[a][a], odd * f.YB[a][b],
        f.XC[a][a],       f.XC[a][b],       f.YC[a][a], f.YC[a][b], odd * f.XG[a][a], odd * f.XG[a][b],
        odd * f.YG[a][a], odd * f.YG[a][b], f.YH[a][a], f.YH[a][b], f.XM[a][a],       f.XM[a][b],
        f.YM[a][a],       f.YM[a][b],       f.ZM[a][a], f.ZM[a][b]};
  };
  return {of(0, 1, 1), of(1, 0, -1)};
}

ResistanceScalars two_sphere_series(double xi, double lambda, double* asymmetry) {
  const auto exact = two_sphere_series_pair(xi, lambda, asymmetry).one;
  std::array<double, ResistanceScalars::count> f;
  std::transform(exact.begin(), exact.end(), f.begin(), [](Real x) { return static_cast<double>(x); });
  return ResistanceScalars::from(f);
}

}  // namespace crumble
