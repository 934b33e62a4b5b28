#include "dryer/relaxation_rate.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

#include "common/numerics/noise.hpp"

namespace crumble::dryer {

namespace {

constexpr int steps = 48;
constexpr double failure = 1e-9;

// Sum over places in the same order on any number of threads.
template <class Term>
double sum(std::size_t places, Term term) {
  constexpr std::size_t piece = 1024;
  std::vector<double> part((places + piece - 1) / piece);
#pragma omp parallel for schedule(static) if (places > many)
  for (std::size_t k = 0; k < part.size(); ++k) {
    double own = 0;
    for (std::size_t m = k * piece; m < std::min((k + 1) * piece, places); ++m) own += term(m);
    part[k] = own;
  }
  double total = 0;
  for (const double own : part) total += own;
  return total;
}

double dot(const Six& u, const Six& v) { return (u * v).sum(); }

}  // namespace

void Mobility::resize(std::size_t count) {
  translation.resize(count);
  rotation.resize(count);
}

// In displacements and rotations u, in which the matrix mobility times stiffness is symmetric under the product
// <u, v> = sum u v/mobility.
double relaxation_rate(BondBlock& bonds, const Mobility& mobility) {
  const std::size_t places = mobility.translation.size();
  if (bonds.size() == 0) return 0;
  std::vector<SixVector> current(places), before(places);
  const auto norm = [&](const std::vector<SixVector>& u) {
    return std::sqrt(sum(places, [&](std::size_t m) { return dot(load(u[m]) / mobility.of(m), load(u[m])); }));
  };
  const auto scale = [&](std::vector<SixVector>& u, double factor) {
#pragma omp parallel for schedule(static) if (places > many)
    for (std::size_t m = 0; m < places; ++m) store(u[m], static_cast<float>(factor) * load(u[m]));
  };
#pragma omp parallel for schedule(static) if (places > many)
  for (std::size_t m = 0; m < places; ++m) {
    const auto x = random_normals(0, Purpose::eigenvector, static_cast<std::uint32_t>(m), 0),
               y = random_normals(0, Purpose::eigenvector, static_cast<std::uint32_t>(m), 1);
    const double way = std::sqrt(mobility.translation[m]), turn = std::sqrt(mobility.rotation[m]);
    current[m] =
        six_vector((Vector6() << way * x[0], way * x[1], way * x[2], turn * x[3], turn * y[0], turn * y[1]).finished());
  }
  scale(current, 1 / norm(current));

  Eigen::VectorXd diagonal(steps), beside(steps);
  int done = 0;
  for (double beta = 0; done < steps;) {
    bonds.respond(current);
    const double alpha = sum(places, [&](std::size_t m) {
      const Six response = bonds.load_on(m), own = load(current[m]);
      store(before[m], -mobility.of(m) * response - static_cast<float>(beta) * load(before[m]));
      return -dot(response, own);
    });
    beta = std::sqrt(sum(places, [&](std::size_t m) {
      const Six next = load(before[m]) - static_cast<float>(alpha) * load(current[m]);
      store(before[m], next);
      return dot(next / mobility.of(m), next);
    }));
    diagonal[done] = alpha;
    beside[done++] = beta;
    if (!(beta > 1e-5 * alpha)) break;  // all directions that there are
    scale(before, 1 / beta);
    std::swap(current, before);
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal.head(done), beside.head(done - 1), Eigen::EigenvaluesOnly);
  const double rows = 6 * static_cast<double>(places),
               root = std::log(1.648 * std::sqrt(rows) / failure) / (2 * steps - 1);
  return solver.eigenvalues().maxCoeff() / (1 - root * root);
}

double rate_increase(const BondBlock& bonds, const Mobility& mobility, double radius, std::size_t place, double known) {
  const auto [displacing, across, turning] = bonds.stiffening_on(place);
  const double mobile = mobility.translation[place], other = turning / (4.0 / 3.0 * radius * radius);
  const auto largest = [](const Eigen::Matrix3f& S) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(S, Eigen::EigenvaluesOnly);
    return static_cast<double>(solver.eigenvalues()[2]);
  };
  // The norm is cheaper and not below; most particles are far from the stiffest.
  double rate = std::max<double>(displacing.norm(), across.norm() + other) * mobile;
  if (rate > known) rate = std::max(largest(displacing), largest(across) + other) * mobile;
  return rate;
}

}  // namespace crumble::dryer
