// Generates the stored two-sphere tables from the exact series. See common/hydro/TWO_SPHERES.md.
//   generate_two_sphere equal > data/two_sphere_equal.inc
//   generate_two_sphere unequal > data/two_sphere_unequal.inc
//   generate_two_sphere reference > data/two_sphere_reference.txt
#include <cmath>
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
int nodes(const Segment& segment) { return segment.variable == Variable::gap ? 3 : degree + 1; }

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

// Root i of the Chebyshev polynomial of degree n, and T_j there.
Real root(int i, int n) { return real_cos(real_pi() * (2 * i + 1) / (2 * n)); }
Real polynomial_at_root(int j, int i, int n) { return real_cos(j * real_pi() * (2 * i + 1) / (2 * n)); }

void subtract_singular(Values& f, Real xi, Real lambda) {
  const auto forms = near_field(lambda);
  const Real log = -real_log(xi);
  for (int k = 0; k < count; ++k) f[k] -= forms[k].inverse / xi + forms[k].log * log + forms[k].xi_log * xi * log;
}

struct PairValues {
  Values one, two;
};

// Chebyshev coefficients in the gap, by interpolation at the roots of the first polynomial left out.
std::vector<PairValues> chebyshev(const Segment& segment, Real lambda) {
  const int n = nodes(segment);
  std::vector<PairValues> coefficient(n, PairValues{});
  for (int i = 0; i < n; ++i) {
    const Real xi = gap_at(segment, root(i, n));
    PairSeries f = two_sphere_series_pair(xi, lambda);
    if (segment.singular) {
      subtract_singular(f.one, xi, lambda);
      subtract_singular(f.two, xi, 1 / lambda);
    }
    for (int j = 0; j < n; ++j) {
      const Real weight = polynomial_at_root(j, i, n) * (j == 0 ? 1 : 2) / n;
      for (int k = 0; k < count; ++k) {
        coefficient[j].one[k] += f.one[k] * weight;
        coefficient[j].two[k] += f.two[k] * weight;
      }
    }
  }
  return coefficient;
}

// Values below the given size are far below every error quoted: not worth a digit.
void write_row(const Values& row, const char* format, double negligible) {
  std::printf("{{");
  for (int k = 0; k < count; ++k) {
    const double value = static_cast<double>(row[k]);
    if (value < negligible && value > -negligible)
      std::printf("0,");
    else
      std::printf(format, value);
  }
  std::printf("}},\n");
}

void write_equal() {
  std::printf(
      "// Chebyshev coefficients of the resistance scalars of two equal spheres; [segment][degree][scalar], layout in\n"
      "// common/hydro/two_sphere_table.hpp. Generated: generate_two_sphere equal > data/two_sphere_equal.inc\n{{\n");
  for (const Segment& segment : segments) {
    auto coefficient = chebyshev(segment, 1);
    coefficient.resize(degree + 1, PairValues{});
    std::printf("{{\n");
    for (const PairValues& row : coefficient) write_row(row.one, "%.17g,", 1e-14);
    std::printf("}},\n");
  }
  std::printf("}}\n");
}

// For each ratio range, segment and gap degree: the rows of ratio degree 0, 1, ... up to the last that matters.
void write_unequal() {
  constexpr double negligible = 1e-9;
  constexpr int n = ratio_degree + 1;
  std::vector<Values> rows[ratio_ranges];
  std::vector<int> row_count[ratio_ranges];
  for (const Segment& segment : segments) {
    // coefficient[range][gap degree][ratio degree]
    std::vector<std::vector<Values>> coefficient[ratio_ranges];
    for (auto& range : coefficient) range.assign(degree + 1, std::vector<Values>(n, Values{}));
    for (int i = 0; i < n; ++i) {
      // One solution serves both ranges: ratio 1/lambda is the same pair seen from the other sphere.
      const Real lambda = real_exp((1 + root(i, n)) / 2 * real_log(Real(largest_ratio)));
      const auto in_gap = chebyshev(segment, lambda);
      const double a1 = static_cast<double>(2 / (1 + lambda)), a2 = static_cast<double>(2 * lambda / (1 + lambda));
      const SelfScale small(a1, a2), large(a2, a1);
      for (int j = 0; j < static_cast<int>(in_gap.size()); ++j)
        for (int l = 0; l < n; ++l) {
          const Real weight = polynomial_at_root(l, i, n) * (l == 0 ? 1 : 2) / n;
          for (int k = 0; k < count; ++k) {
            coefficient[1][j][l][k] += in_gap[j].one[k] * weight / small.of(k);
            coefficient[0][j][l][k] += in_gap[j].two[k] * weight / large.of(k);
          }
        }
    }
    for (int range = 0; range < ratio_ranges; ++range)
      for (const auto& row : coefficient[range]) {
        int last = 0;
        for (int l = 0; l < n; ++l)
          for (const Real c : row[l])
            if (c > negligible || c < -negligible) last = l + 1;
        row_count[range].push_back(last);
        rows[range].insert(rows[range].end(), row.begin(), row.begin() + last);
      }
  }
  std::printf(
      "// Chebyshev coefficients of the resistance scalars of two unequal spheres, layout in\n"
      "// common/hydro/two_sphere_table.hpp. Generated: generate_two_sphere unequal > data/two_sphere_unequal.inc\n"
      "// Rows of each [range][segment][gap degree].\nconstexpr RowCounts unequal_row_counts = {{\n");
  for (const auto& range : row_count) {
    std::printf("{{\n");
    for (std::size_t i = 0; i < range.size(); ++i)
      std::printf("%s%d,%s", i % (degree + 1) == 0 ? "{{" : "", range[i], i % (degree + 1) == degree ? "}},\n" : "");
    std::printf("}},\n");
  }
  std::printf("}};\nconstexpr std::array<std::array<double, columns>, %zu> unequal_rows = {{\n",
              rows[0].size() + rows[1].size());
  for (const auto& range : rows)
    for (const Values& row : range) write_row(row, "%.11f,", 5e-12);
  std::printf("}};\n");
}

void write_point(double gap, double ratio) {
  std::printf("%.17g %.17g", gap, ratio);
  for (const Real f : two_sphere_series_pair(gap, ratio).one) std::printf(" %.16g", static_cast<double>(f));
  std::printf("\n");
}

// Gaps and ratios that are nobody's node, over the whole range, for the test of the table.
void write_reference() {
  std::printf("# Exact two-sphere resistance scalars: gap over mean radius, radius ratio a2/a1, then");
  for (const char* name : ResistanceScalars::names) std::printf(" %s", name);
  std::printf("\n# Generated: generate_two_sphere reference > data/two_sphere_reference.txt\n");
  constexpr int points = 48;
  const auto spread = [](double from, double decades, double share) { return from * std::pow(10, decades * share); };
  for (int i = 0; i < points; ++i) write_point(spread(1e-6, 10, (i + 0.37) / points), 1);
  // Ratios by the golden section, so that every stretch of gaps meets small and large ones; then the ends.
  for (int i = 0; i < points; ++i)
    write_point(spread(3e-6, 9, (i + 0.61) / points), spread(0.1, 2, std::fmod(0.5 + 0.6180339887498949 * i, 1.0)));
  for (const double ratio : {smallest_ratio, largest_ratio})
    for (const double gap : {1e-5, 1e-3, 0.02, 0.5, 4.0, 100.0}) write_point(gap, ratio);
}

}  // namespace
}  // namespace crumble::two_sphere

int main(int argc, char** argv) try {
  const std::string what = argc == 2 ? argv[1] : "";
  if (what == "equal") {
    crumble::two_sphere::write_equal();
  } else if (what == "unequal") {
    crumble::two_sphere::write_unequal();
  } else if (what == "reference") {
    crumble::two_sphere::write_reference();
  } else {
    std::fprintf(stderr, "usage: generate_two_sphere equal|unequal|reference > FILE\n");
    return 2;
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "generate_two_sphere: %s\n", error.what());
  return 1;
}
