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

using Coefficients = std::array<std::array<std::array<double, columns>, degree + 1>, segments.size()>;

}  // namespace crumble::two_sphere
