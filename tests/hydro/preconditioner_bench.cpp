// Why the iterations without a matrix take a sparse inverse factor (sparse_inverse.hpp) and not a factor of the near
// field: the force on a cluster that moves along x, M f = w by conjugate gradients, with either.
//
//   bench_preconditioner spheres [cut-offs of the near field, radii]
//
// The near field of M is M times Wendland's (1 - r/c)^4 (1 + 4 r/c) block by block, which keeps it positive definite
// at any cut-off c; CHOLMOD, METIS ordering. Processor time.
#include <fmt/format.h>

#include <ctime>
#include <functional>
#include <numbers>

#include "common/hydro/far_field_sum.hpp"
#include "common/hydro/sparse_inverse.hpp"
#include "common/numerics/sparse_cholesky.hpp"
#include "lattice.hpp"

using namespace crumble;
using namespace crumble::testing;

namespace {

double now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

using Apply = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

// Rows of M by sphere, (E, U, Omega), so that its pattern is one of blocks.
Eigen::VectorXd by_sphere(const Eigen::VectorXd& v, int n) {
  Eigen::VectorXd x(v.size());
  for (int i = 0; i < n; ++i) x.segment<11>(11 * i) << v.segment<5>(5 * i), v.segment<6>(5 * n + 6 * i);
  return x;
}
Eigen::VectorXd by_kind(const Eigen::VectorXd& x, int n) {
  Eigen::VectorXd v(x.size());
  for (int i = 0; i < n; ++i) {
    v.segment<5>(5 * i) = x.segment<5>(11 * i);
    v.segment<6>(5 * n + 6 * i) = x.segment<6>(11 * i + 5);
  }
  return v;
}

Eigen::SparseMatrix<double> near_field(const Spheres& s, double cut_off) {
  using Block = Eigen::Matrix<double, 11, 11>;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < s.size(); ++i)
    for (int j = 0; j <= i; ++j) {
      const Vector3 r = s.position[i] - s.position[j];
      const double x = r.norm() / cut_off;
      if (x >= 1) continue;
      Block block = Block::Zero();
      if (i == j) {
        const SelfMobility self(s.radius[i]);
        block.diagonal() << Vector5::Constant(self.stresslet), Vector3::Constant(self.force),
            Vector3::Constant(self.torque);
      } else {
        const PairMobility m = pair_mobility(r, s.radius[i], s.radius[j]);
        block << m.strain_stresslet, m.strain_force, m.motion_stresslet, m.motion_force;
      }
      block *= std::pow(1 - x, 4) * (1 + 4 * x);
      for (int row = 0; row < 11; ++row)
        for (int column = 0; column < 11; ++column)
          if (i > j || row >= column) entries.emplace_back(11 * i + row, 11 * j + column, block(row, column));
    }
  Eigen::SparseMatrix<double> M(11 * s.size(), 11 * s.size());
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

void measure(const std::string& name, double set_up, const Spheres& s, const Apply& precondition) {
  const FarFieldSum M(s);
  const int n = s.size();
  Eigen::VectorXd w = Eigen::VectorXd::Zero(11 * n);
  for (int i = 0; i < n; ++i) w[5 * n + 6 * i] = 1;
  for (const double tolerance : {1e-5, 1e-8}) {
    const double begin = now();
    Eigen::VectorXd f = Eigen::VectorXd::Zero(11 * n), r = w, z = precondition(r), p = z, Mp(11 * n);
    int iterations = 0;
    for (double rho = r.dot(z); r.norm() > tolerance * w.norm() && iterations < 500; ++iterations) {
      M.apply(p.data(), Mp.data());
      const double alpha = rho / p.dot(Mp);
      f += alpha * p;
      const Eigen::VectorXd before = r;
      r -= alpha * Mp;
      z = precondition(r);
      const double next = r.dot(z);
      p = z + (next - before.dot(z)) / rho * p;
      rho = next;
    }
    double force = 0;
    for (int i = 0; i < n; ++i) force += f[5 * n + 6 * i];
    fmt::print("{:<24} {:>8} {:>9.0e} {:>10} {:>9.2f} {:>9.2f} {:>12.6f}\n", name, n, tolerance, iterations, set_up,
               now() - begin, force / (6 * std::numbers::pi));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::atoi(argv[1]) : 2000;
  const Spheres s = n > 2000 ? lattice_ball(n) : grown({n, 0, 1e9, 12, 0, 1});
  fmt::print("{:<24} {:>8} {:>9} {:>10} {:>9} {:>9} {:>12}\n", "preconditioner", "spheres", "tolerance", "iterations",
             "set-up s", "solve s", "drag");
  double begin = now();
  const SparseInverse inverse(s, 30);
  measure("sparse inverse", now() - begin, s, [&](const Eigen::VectorXd& r) { return inverse.apply(r); });
  for (int k = 2; k < argc; ++k) {
    begin = now();
    SparseCholesky factor;
    factor.compute(near_field(s, std::atof(argv[k])));
    if (factor.info() != Eigen::Success) return 1;
    measure(fmt::format("near field to {} a", argv[k]), now() - begin, s,
            [&](const Eigen::VectorXd& r) { return by_kind(factor.solve(by_sphere(r, n)), n); });
  }
}
