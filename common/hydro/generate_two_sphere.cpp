// Generates the stored two-sphere tables from the exact series. See common/hydro/README.md, "Two spheres".
//   generate_two_sphere equal > data/two_sphere_equal.inc
//   generate_two_sphere reference > data/two_sphere_reference.txt
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "common/hydro/near_field.hpp"
#include "common/hydro/two_sphere_series.hpp"
#include "common/hydro/two_sphere_table.hpp"

namespace crumble::two_sphere {
namespace {

constexpr int count = ResistanceScalars::count;
using Values = std::array<Real, count>;

// The first segment only has to follow a line and a trace of xi^2 ln xi; few nodes keep clear of gaps that cost
// minutes.
int nodes(const Segment& segment) { return segment.variable == Variable::gap ? 5 : degree + 1; }

Real gap_at(const Segment& segment, Real t) {
  const Real begin = segment.begin, end = segment.end;
  switch (segment.variable) {
    case Variable::gap:
      return end * (1 + t) / 2;
    case Variable::log_gap:
      return begin * real_exp((1 + t) / 2 * real_log(end / begin));
    case Variable::separation:
      return 2 * (2 + begin) / (1 + t) - 2;
  }
  return 0;
}

Values remainder(const Segment& segment, Real xi, Real lambda) {
  Values f = two_sphere_series_real(xi, lambda);
  if (!segment.singular) return f;
  const auto forms = near_field(lambda);
  const Real log = -real_log(xi);
  for (int k = 0; k < count; ++k) f[k] -= forms[k].inverse / xi + forms[k].log * log + forms[k].xi_log * xi * log;
  return f;
}

// Chebyshev coefficients by interpolation at the roots of the first polynomial left out.
std::vector<Values> chebyshev(const Segment& segment, Real lambda) {
  const int n = nodes(segment);
  std::vector<Values> coefficient(n, Values{});
  for (int i = 0; i < n; ++i) {
    const Real angle = real_pi() * (2 * i + 1) / (2 * n);
    const Values f = remainder(segment, gap_at(segment, real_cos(angle)), lambda);
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < count; ++k) coefficient[j][k] += f[k] * real_cos(j * angle) * (j == 0 ? 1 : 2) / n;
  }
  return coefficient;
}

void write_equal() {
  std::printf(
      "// Chebyshev coefficients of the resistance scalars of two equal spheres; [segment][degree][scalar], layout in\n"
      "// common/hydro/two_sphere_table.hpp. Generated: generate_two_sphere equal > data/two_sphere_equal.inc\n{{\n");
  for (const Segment& segment : segments) {
    const auto coefficient = chebyshev(segment, 1);
    std::printf("{{\n");
    for (int j = 0; j <= degree; ++j) {
      std::printf("{{");
      for (int k = 0; k < columns; ++k) {
        const bool stored = k < count && j < static_cast<int>(coefficient.size());
        const double value = stored ? static_cast<double>(coefficient[j][k]) : 0;
        // Far below every error quoted: not worth a digit.
        if (value < 1e-14 && value > -1e-14)
          std::printf("0,");
        else
          std::printf("%.17g,", value);
      }
      std::printf("}},\n");
    }
    std::printf("}},\n");
  }
  std::printf("}}\n");
}

// Gaps that are nobody's node, over the whole range, for the test of the table.
void write_reference() {
  std::printf("# Exact two-sphere resistance scalars: gap over mean radius, radius ratio a2/a1, then");
  for (const char* name : ResistanceScalars::names) std::printf(" %s", name);
  std::printf("\n# Generated: generate_two_sphere reference > data/two_sphere_reference.txt\n");
  constexpr int points = 48;
  for (int i = 0; i < points; ++i) {
    const Real xi = real_exp(real_log(Real(1e-6)) + (i + Real(0.37)) / points * real_log(Real(1e10)));
    const double gap = static_cast<double>(xi);
    std::printf("%.17g 1", gap);
    for (const Real f : two_sphere_series_real(gap, 1)) std::printf(" %.16g", static_cast<double>(f));
    std::printf("\n");
  }
}

}  // namespace
}  // namespace crumble::two_sphere

int main(int argc, char** argv) try {
  const std::string what = argc == 2 ? argv[1] : "";
  if (what == "equal") {
    crumble::two_sphere::write_equal();
  } else if (what == "reference") {
    crumble::two_sphere::write_reference();
  } else {
    std::fprintf(stderr, "usage: generate_two_sphere equal|reference > FILE\n");
    return 2;
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "generate_two_sphere: %s\n", error.what());
  return 1;
}
