#include "common/agglomerate/projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/numerics/sparse_cholesky.hpp"

namespace crumble {
namespace {

using Eigen::VectorXd;
using Sparse = SparseCholesky::Matrix;
using Index = Eigen::Index;

std::string name(std::size_t i, std::size_t j) { return std::to_string(i) + "-" + std::to_string(j); }

// Residuals and unit normals of the links at given positions.
struct Residuals {
  VectorXd value;
  std::vector<Vector3> normal;
  double cost() const { return value.squaredNorm(); }
};

Residuals residuals(const std::vector<Link>& links, const std::vector<Vector3>& x) {
  Residuals r{VectorXd(static_cast<Index>(links.size())), {}};
  r.normal.reserve(links.size());
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Vector3 d = x[links[k].j] - x[links[k].i];
    const double length = d.norm();
    if (!(length > 0)) {
      throw std::invalid_argument("closing: particles " + name(links[k].i, links[k].j) +
                                  " have the same centre (or one that is not finite)");
    }
    r.value[static_cast<Index>(k)] = length - links[k].distance;
    r.normal.push_back(d / length);
  }
  return r;
}

// The links' matrix J J^T: 2 on the diagonal, +-n_k.n_l where two links share a particle.
class LinkMatrix {
 public:
  LinkMatrix(const std::vector<Link>& links, std::size_t particle_count) : links_(links), ends_(particle_count) {
    for (std::size_t k = 0; k < links.size(); ++k) {
      ends_[links[k].i].emplace_back(k, -1.0);
      ends_[links[k].j].emplace_back(k, +1.0);
    }
  }

  // y = -(J J^T + lambda)^-1 C; false if the factorisation broke down.
  bool solve(const Residuals& r, double lambda, VectorXd& y) {
    const Sparse matrix = assemble(r);
    if (!analysed_) solver_.analyzePattern(matrix);
    analysed_ = true;
    solver_.setShift(lambda);
    solver_.factorize(matrix);
    if (solver_.info() != Eigen::Success) return false;
    y = -solver_.solve(r.value);
    return y.allFinite();
  }

  // dx = J^T y
  std::vector<Vector3> moves(const Residuals& r, const VectorXd& y) const {
    std::vector<Vector3> dx(ends_.size(), Vector3::Zero());
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const Vector3 along = y[static_cast<Index>(k)] * r.normal[k];
      dx[links_[k].i] -= along;
      dx[links_[k].j] += along;
    }
    return dx;
  }

 private:
  Sparse assemble(const Residuals& r) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < links_.size(); ++k) entries.emplace_back(static_cast<int>(k), static_cast<int>(k), 2.0);
    for (const auto& at_particle : ends_) {
      for (std::size_t p = 0; p < at_particle.size(); ++p) {
        for (std::size_t q = 0; q < p; ++q) {
          const auto [k, sign_k] = at_particle[p];
          const auto [l, sign_l] = at_particle[q];
          entries.emplace_back(static_cast<int>(k), static_cast<int>(l),
                               sign_k * sign_l * r.normal[k].dot(r.normal[l]));
        }
      }
    }
    Sparse lower(static_cast<Index>(links_.size()), static_cast<Index>(links_.size()));
    lower.setFromTriplets(entries.begin(), entries.end());
    return lower;
  }

  const std::vector<Link>& links_;
  std::vector<std::vector<std::pair<std::size_t, double>>> ends_;  // links of each particle, with the sign of n there
  SparseCholesky solver_;
  bool analysed_ = false;
};

// The largest change of a link, relative to its length. Its part across the link is what the linearisation neglects; a
// common motion of both ends, however long, is harmless.
double longest_change(const std::vector<Link>& links, const std::vector<Vector3>& dx) {
  double change = 0;
  for (const Link& link : links) change = std::max(change, (dx[link.j] - dx[link.i]).norm() / link.distance);
  return change;
}

}  // namespace

Projected project(const std::vector<Link>& links, std::vector<Vector3>& x) {
  constexpr double largest_change = 0.1;  // linearised distances are then off by up to 0.5 %
  constexpr double least_damping = 1e-12, most_damping = 1e8;
  constexpr int most_iterations = 300, patience = 3;
  Projected outcome;
  if (links.empty()) return outcome;
  double extent = 0;
  for (const Vector3& p : x) extent = std::max(extent, p.norm());
  const double round_off = 2 * std::numeric_limits<double>::epsilon() * (1 + extent);

  LinkMatrix matrix(links, x.size());
  Residuals r = residuals(links, x);
  double damping = 1e-6;
  int poor_steps = 0;
  VectorXd y;
  while (r.value.lpNorm<Eigen::Infinity>() > round_off) {
    if (damping > most_damping) break;  // no way down: the residual is at its least
    if (++outcome.iterations > most_iterations) {
      outcome.converged = false;
      break;
    }
    if (!matrix.solve(r, damping, y)) {
      damping *= 100;
      continue;
    }
    const std::vector<Vector3> dx = matrix.moves(r, y);
    if (longest_change(links, dx) > largest_change) {
      damping *= 10;
      continue;
    }
    std::vector<Vector3> next = x;
    for (std::size_t i = 0; i < x.size(); ++i) next[i] += dx[i];
    Residuals then = residuals(links, next);
    if (!(then.cost() < r.cost())) {
      damping *= 10;
      continue;
    }
    // Where the network can close, every step gains digits. Where it cannot, the stiff modes are done after a step or
    // two, and what follows trades ever longer slides along soft modes for a per cent of self-stress: not wanted.
    const double gain = 1 - then.cost() / r.cost();
    poor_steps = gain < 0.5 ? poor_steps + 1 : 0;
    x = std::move(next);
    r = std::move(then);
    damping = std::max(damping / (gain > 0.9 ? 100 : 10), least_damping);
    if (poor_steps == patience) break;
  }
  return outcome;
}

}  // namespace crumble
