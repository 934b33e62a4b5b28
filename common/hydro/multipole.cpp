#include "common/hydro/multipole.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/hydro/multipole_table.hpp"

namespace crumble {

namespace {

using multipole::Density;
using multipole::Family;
using std::numbers::pi;

double double_factorial(int n) {
  double result = 1;
  for (; n > 1; n -= 2) result *= n;
  return result;
}

// Per sphere and unknown: what turns a pair term of the polynomials into one of scaled unknowns, as receiver and as
// source, and the unknown's own entry.
struct Scales {
  Eigen::VectorXd receiver, source, self;
};

// Force, torque and stresslet of the density of unit norm, with the sign that makes n x grad R a positive torque.
double physical_moment(const Density& d, double a) {
  if (d.family == Family::W && d.j == 1) return std::sqrt(4 * pi) * a;
  if (d.family == Family::X && d.j == 1) return -std::sqrt(8 * pi / 3) * a * a;
  if (d.family == Family::W && d.j == 2) return std::sqrt(4 * pi / 3) * a * a;
  return 0;
}

Scales scales(const std::vector<Density>& list, double a) {
  const auto n = static_cast<Eigen::Index>(list.size());
  Scales s{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Density& d = list[k];
    const int l = d.degree();
    const double average = std::sqrt(1 / (8 * pi)) * 4 * pi * std::pow(a, l + 2) / double_factorial(2 * l + 1);
    const double norm = a * std::sqrt(squared_norm(d)), own = eigenvalue(d) * a;
    const double moment = physical_moment(d, a);
    const double unit = moment != 0 ? moment : std::sqrt(own);
    s.receiver[k] = average / (norm * unit);
    s.source[k] = l % 2 == 0 ? s.receiver[k] : -s.receiver[k];
    s.self[k] = own / (unit * unit);
  }
  return s;
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void pair_block(const multipole::PairTable& table, const std::vector<double>& V, RowMajor& block) {
  const auto* term = table.terms.data();
  const int count = table.unknowns * table.unknowns;
  for (int e = 0; e < count; ++e) {
    double sum = 0;
    for (const auto* end = table.terms.data() + table.first[e + 1]; term < end; ++term)
      sum += term->value * V[term->index];
    block.data()[e] = sum;
  }
}

}  // namespace

MobilityMatrix multipole_mobility(const Spheres& spheres, int order) {
  if (order < 1 || order > highest_multipole_order)
    throw std::invalid_argument(
        fmt::format("multipole order {} is not between 1 and {}", order, highest_multipole_order));
  const std::vector<Density> list = multipole::densities(order);
  const multipole::PairTable table(order);
  const int n = spheres.size(), inner = table.unknowns - 6;
  MobilityMatrix matrix;
  matrix.spheres = n;
  matrix.interior_per_sphere = inner;
  matrix.lower.setZero(table.unknowns * n, table.unknowns * n);
  auto& M = matrix.lower;

  std::vector<Scales> scale;
  for (const double a : spheres.radius) scale.push_back(scales(list, a));
#pragma omp parallel for schedule(dynamic) if (n > 8)
  for (int j = 0; j < n; ++j) {
    RowMajor block(table.unknowns, table.unknowns);
    std::vector<double> V;
    M.diagonal().segment(inner * j, inner) = scale[j].self.head(inner);
    M.diagonal().segment(inner * n + 6 * j, 6) = scale[j].self.tail(6);
    for (int i = j + 1; i < n; ++i) {
      table.fill(spheres.position[i] - spheres.position[j], spheres.radius[i], spheres.radius[j], V);
      pair_block(table, V, block);
      block = scale[i].receiver.asDiagonal() * block * scale[j].source.asDiagonal();
      M.block(inner * i, inner * j, inner, inner) = block.topLeftCorner(inner, inner);
      M.block(inner * n + 6 * i, inner * j, 6, inner) = block.bottomLeftCorner(6, inner);
      M.block(inner * n + 6 * j, inner * i, 6, inner) = block.topRightCorner(inner, 6).transpose();
      M.block(inner * n + 6 * i, inner * n + 6 * j, 6, 6) = block.bottomRightCorner(6, 6);
    }
  }
  return matrix;
}

}  // namespace crumble
