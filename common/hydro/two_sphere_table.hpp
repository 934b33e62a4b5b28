// Layout of the stored two-sphere table: what the generator writes and two_sphere.cpp reads.
#pragma once

#include <array>
#include <cmath>

#include "common/hydro/two_sphere_scalars.hpp"

namespace crumble::two_sphere {

// The range of gaps xi (over the mean radius) is cut into segments; in each, every scalar is a Chebyshev series of
// degree `degree` in a variable that makes the remainder smooth. Up to near_end the series holds the scalar minus its
// singular part (near_field.hpp), beyond it the scalar itself.
enum class Variable {
  gap,         // xi: down to contact
  log_gap,     // ln xi: the only other singularities lie on xi < 0, half a turn away
  separation,  // 1/(2 + xi): out to infinity
};

struct Segment {
  double begin, end;  // in xi
  Variable variable;
  bool singular;  // the singular part was subtracted
};

inline constexpr int degree = 14;
inline constexpr int columns = 24;  // ResistanceScalars::count, filled up to whole SIMD registers
inline constexpr std::array<Segment, 5> segments = {{
    {0, 3e-5, Variable::gap, true},
    {3e-5, 3e-3, Variable::log_gap, true},
    {3e-3, 0.2, Variable::log_gap, true},
    {0.2, 2, Variable::log_gap, false},
    {2, 1e300, Variable::separation, false},
}};

// Position of a gap within its segment: t in [-1, 1] is the argument of the Chebyshev polynomials.
struct Location {
  std::size_t segment;
  double t;
  double log_gap;  // ln xi; not set where no use is made of it
};

inline Location locate(double xi) {
  std::size_t k = 0;
  while (k + 1 < segments.size() && xi > segments[k].end) ++k;
  const Segment& s = segments[k];
  if (s.variable == Variable::separation) return {k, 2 * (2 + s.begin) / (2 + xi) - 1, 0};
  const double log_gap = std::log(xi);
  if (s.variable == Variable::gap) return {k, 2 * xi / s.end - 1, log_gap};
  static const auto log_border = [] {
    std::array<double, segments.size() + 1> border{};
    for (std::size_t i = 1; i < segments.size(); ++i) border[i] = std::log(segments[i].begin);
    return border;
  }();
  return {k, (2 * log_gap - log_border[k] - log_border[k + 1]) / (log_border[k + 1] - log_border[k]), log_gap};
}

// Unequal spheres: in each segment and for each of two ranges of the radius ratio (0.1 ... 1 and 1 ... 10) the
// Chebyshev coefficients of above are themselves Chebyshev series in lg(ratio), of a degree that falls with the gap
// degree. Scalars are divided by `self_scale` first, so that both spheres' scalars are of order one.
inline constexpr double smallest_ratio = 0.1, largest_ratio = 10;
inline constexpr int ratio_ranges = 2;
inline constexpr int ratio_degree = 12;  // at most

// Argument of the Chebyshev polynomials in the ratio, -1 at equal spheres in both ranges.
inline double ratio_argument(double ratio) { return 2 * std::abs(std::log10(ratio)) - 1; }

// Scale of scalar k of a sphere of radius a1 beside one of radius a2: what positive definiteness bounds its far-field
// value by, a^(1/2) for each force and a^(3/2) for each torque or stresslet that it couples.
struct SelfScale {
  double one[3], pair[3];  // by order: A; B and G; C, H and M. one: f11, pair: f12
  SelfScale(double a1, double a2) : one{a1, a1 * a1, a1 * a1 * a1}, pair{} {
    const double root = std::sqrt(a1 * a2);
    pair[0] = root;
    pair[1] = a1 * root;
    pair[2] = a1 * a2 * root;
  }
  double of(int k) const {
    constexpr int order[ResistanceScalars::count / 2] = {0, 0, 1, 2, 2, 1, 1, 2, 2, 2, 2};
    return k % 2 == 0 ? one[order[k / 2]] : pair[order[k / 2]];
  }
};

using Coefficients = std::array<std::array<std::array<double, columns>, degree + 1>, segments.size()>;
using RowCounts = std::array<std::array<std::array<int, degree + 1>, segments.size()>, ratio_ranges>;

}  // namespace crumble::two_sphere
