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

using Column = std::array<double, columns>;

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

ResistanceScalars evaluate(double gap, const Coefficients& coefficients, const SingularColumns& singular) {
  const Location at = locate(gap);
  const auto& c = coefficients[at.segment];
  // Clenshaw's recurrence, eight scalars at a time so that it stays in registers.
  Column f;
  constexpr int block = 8;
  for (int first = 0; first < columns; first += block) {
    double b1[block] = {}, b2[block] = {};
    for (int n = degree; n >= 1; --n)
      for (int k = 0; k < block; ++k) {
        const double b0 = 2 * at.t * b1[k] - b2[k] + c[n][first + k];
        b2[k] = b1[k];
        b1[k] = b0;
      }
    for (int k = 0; k < block; ++k) f[first + k] = at.t * b1[k] - b2[k] + c[0][first + k];
  }
  if (segments[at.segment].singular) {
    const double inverse = 1 / gap, xi_log = -gap * at.log_gap;
    for (int k = 0; k < columns; ++k)
      f[k] += singular.inverse[k] * inverse - singular.log[k] * at.log_gap + singular.xi_log[k] * xi_log;
  }
  std::array<double, ResistanceScalars::count> values;
  std::copy_n(f.begin(), ResistanceScalars::count, values.begin());
  return ResistanceScalars::from(values);
}

}  // namespace

ResistanceScalars two_sphere_resistance(double gap, double radius_ratio) {
  if (!(gap > 0))
    throw std::invalid_argument("two_sphere_resistance: gap must be positive, got " + std::to_string(gap));
  if (radius_ratio != 1)
    throw std::invalid_argument("two_sphere_resistance: only equal spheres are tabulated, got a radius ratio of " +
                                std::to_string(radius_ratio));
  return evaluate(gap, equal_spheres, equal_singular);
}

ResistanceScalars swapped(const ResistanceScalars& f) {
  ResistanceScalars g = f;
  for (double* odd : {&g.YB11, &g.YB12, &g.XG11, &g.XG12, &g.YG11, &g.YG12}) *odd = -*odd;
  return g;
}

}  // namespace crumble
