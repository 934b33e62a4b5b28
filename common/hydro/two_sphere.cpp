#include "common/hydro/two_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/hydro/near_field.hpp"
#include "common/hydro/two_sphere_table.hpp"

namespace crumble {

using namespace two_sphere;

namespace {

constexpr Coefficients equal_spheres =
#include "data/two_sphere_equal.inc"
    ;
#include "data/two_sphere_unequal.inc"

// Where the rows of a [range][segment][gap degree] of unequal_rows begin.
constexpr RowCounts unequal_row_begin = [] {
  RowCounts begin{};
  int next = 0;
  for (int range = 0; range < ratio_ranges; ++range)
    for (std::size_t s = 0; s < segments.size(); ++s)
      for (int j = 0; j <= degree; ++j) {
        begin[range][s][j] = next;
        next += unequal_row_counts[range][s][j];
      }
  return begin;
}();

using Column = std::array<double, columns>;
using SegmentCoefficients = std::array<Column, degree + 1>;

struct SingularColumns {
  Column inverse{}, log{}, xi_log{};
};

constexpr SingularColumns singular_columns(double lambda) {
  const auto forms = near_field(lambda);
  SingularColumns result;
  for (int k = 0; k < ResistanceScalars::count; ++k) {
    result.inverse[k] = forms[k].inverse;
    result.log[k] = forms[k].log;
    result.xi_log[k] = forms[k].xi_log;
  }
  return result;
}
constexpr SingularColumns equal_singular = singular_columns(1);

// Clenshaw's recurrence, eight scalars at a time so that it stays in registers.
Column chebyshev_sum(const SegmentCoefficients& c, double t) {
  Column f;
  constexpr int block = 8;
  for (int first = 0; first < columns; first += block) {
    double b1[block] = {}, b2[block] = {};
    for (int n = degree; n >= 1; --n)
      for (int k = 0; k < block; ++k) {
        const double b0 = 2 * t * b1[k] - b2[k] + c[n][first + k];
        b2[k] = b1[k];
        b1[k] = b0;
      }
    for (int k = 0; k < block; ++k) f[first + k] = t * b1[k] - b2[k] + c[0][first + k];
  }
  return f;
}

void add_singular(Column& f, const SingularColumns& singular, double gap, double log_gap) {
  const double inverse = 1 / gap, xi_log = -gap * log_gap;
  for (int k = 0; k < columns; ++k)
    f[k] += singular.inverse[k] * inverse - singular.log[k] * log_gap + singular.xi_log[k] * xi_log;
}

ResistanceScalars scalars(const Column& f) {
  std::array<double, ResistanceScalars::count> values;
  std::copy_n(f.begin(), ResistanceScalars::count, values.begin());
  return ResistanceScalars::from(values);
}

// The coefficients in the gap for one ratio: the series in the ratio summed row by row.
SegmentCoefficients contracted(std::size_t segment, double ratio) {
  const int range = ratio > 1 ? 1 : 0;
  const double u = ratio_argument(ratio);
  double T[ratio_degree + 1] = {1, u};
  for (int l = 2; l <= ratio_degree; ++l) T[l] = 2 * u * T[l - 1] - T[l - 2];
  SegmentCoefficients c{};
  for (int j = 0; j <= degree; ++j) {
    const int begin = unequal_row_begin[range][segment][j], count = unequal_row_counts[range][segment][j];
    for (int l = 0; l < count; ++l)
      for (int k = 0; k < columns; ++k) c[j][k] += T[l] * unequal_rows[begin + l][k];
  }
  return c;
}

ResistanceScalars unequal_resistance(double gap, double ratio) {
  const Location at = locate(gap);
  Column f = chebyshev_sum(contracted(at.segment, ratio), at.t);
  const SelfScale scale(2 / (1 + ratio), 2 * ratio / (1 + ratio));
  for (int k = 0; k < ResistanceScalars::count; ++k) f[k] *= scale.of(k);
  if (segments[at.segment].singular) add_singular(f, singular_columns(ratio), gap, at.log_gap);
  return scalars(f);
}

}  // namespace

bool is_tabulated(double radius_ratio) {
  constexpr double slack = 1 + 1e-9;  // for a quotient of radii that is 10 but for rounding
  return radius_ratio * slack >= smallest_ratio && radius_ratio <= largest_ratio * slack;
}

ResistanceScalars two_sphere_resistance(double gap, double radius_ratio) {
  if (!(gap > 0))
    throw std::invalid_argument("two_sphere_resistance: gap must be positive, got " + std::to_string(gap));
  if (radius_ratio == 1) {
    const Location at = locate(gap);
    Column f = chebyshev_sum(equal_spheres[at.segment], at.t);
    if (segments[at.segment].singular) add_singular(f, equal_singular, gap, at.log_gap);
    return scalars(f);
  }
  if (!is_tabulated(radius_ratio))
    throw std::invalid_argument("two_sphere_resistance: radius ratios from 0.1 to 10 are tabulated, got " +
                                std::to_string(radius_ratio));
  return unequal_resistance(gap, radius_ratio);
}

ResistanceScalars swapped(const ResistanceScalars& f) {
  ResistanceScalars g = f;
  for (double* odd : {&g.YB11, &g.YB12, &g.XG11, &g.XG12, &g.YG11, &g.YG12}) *odd = -*odd;
  return g;
}

}  // namespace crumble
