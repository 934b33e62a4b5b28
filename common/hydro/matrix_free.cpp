#include "common/hydro/matrix_free.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "common/hydro/krylov.hpp"
#include "common/numerics/sparse_cholesky.hpp"

namespace crumble {

// With M replaced by its diagonal: f_strain = w/m, (1/m + D) u = b, f_motion = u/m.
struct MatrixFreeHydrodynamics::NearField {
  Eigen::VectorXd drag;  // 1/m of stresslets, then of forces and torques
  Eigen::SparseMatrix<double> matrix;
  SparseCholesky factor;

  NearField(const Spheres& s, const Lubrication& lubrication) : drag(11 * s.size()) {
    const int n = s.size();
    for (int i = 0; i < n; ++i) {
      const SelfMobility self(s.radius[i]);
      drag.segment<5>(5 * i).setConstant(1 / self.stresslet);
      drag.segment<3>(5 * n + 6 * i).setConstant(1 / self.force);
      drag.segment<3>(5 * n + 6 * i + 3).setConstant(1 / self.torque);
    }
    Eigen::SparseMatrix<double> own(6 * n, 6 * n);
    own.setIdentity();
    own.diagonal() = drag.tail(6 * n);
    matrix = lubrication.motion_resistance(n) + own;
    factor.compute(matrix);
    if (factor.info() != Eigen::Success) throw std::runtime_error("the near-field resistance is not positive definite");
  }

  Eigen::VectorXd apply(const Eigen::VectorXd& r) const {
    const Eigen::Index motion = matrix.rows(), interior = r.size() - motion;
    Eigen::VectorXd f(r.size());
    f.head(interior) = r.head(interior).cwiseProduct(drag.head(interior));
    f.tail(motion) = factor.solve(r.tail(motion)).cwiseProduct(drag.tail(motion));
    return f;
  }
};

MatrixFreeHydrodynamics::MatrixFreeHydrodynamics(const Spheres& spheres, double viscosity, const HydroModel& model,
                                                 const MatrixFreeSettings& settings)
    : IterativeHydrodynamics(spheres, viscosity, model), settings_(settings) {}

MatrixFreeHydrodynamics::~MatrixFreeHydrodynamics() = default;

void MatrixFreeHydrodynamics::solved(Eigen::Index column, Eigen::Index columns) const {
  most_iterations_ = column == 0 ? iterations_ : std::max(most_iterations_, iterations_);
  if (settings_.on_solved) settings_.on_solved(static_cast<int>(column), static_cast<int>(columns), iterations_);
}

Eigen::VectorXd MatrixFreeHydrodynamics::solve_far_field(const Operator& mobility, const Eigen::VectorXd& w) const {
  if (!inverse_) inverse_ = std::make_unique<SparseInverse>(reduced(), settings_.neighbours);
  iterations_ = 0;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(w.size()), r = w, z = inverse_->apply(r), p = z;
  double rho = r.dot(z);
  const double goal = settings_.tolerance * settings_.tolerance * rho;
  for (; rho > goal && iterations_ < settings_.limit; ++iterations_) {
    const Eigen::VectorXd Mp = mobility(p);
    const double alpha = rho / p.dot(Mp);
    q += alpha * p;
    const Eigen::VectorXd before = r;
    r -= alpha * Mp;
    z = inverse_->apply(r);
    const double next = r.dot(z);
    // Polak & Ribiere: stands a preconditioner in float32, which is symmetric to its round-off only.
    p = z + (next - before.dot(z)) / rho * p;
    rho = next;
  }
  if (!(rho <= goal))
    throw std::runtime_error(
        fmt::format("conjugate gradients on the mobility of {} spheres did not converge in {} iterations", size(),
                    settings_.limit));
  return q;
}

Eigen::VectorXd MatrixFreeHydrodynamics::solve_saddle(const Operator& saddle, const Eigen::VectorXd& b) const {
  if (!near_) near_ = std::make_unique<NearField>(reduced(), pair_lubrication());
  const KrylovResult result = gmres(
      saddle, [this](const Eigen::VectorXd& r) { return near_->apply(r); }, b, settings_.tolerance, settings_.limit);
  if (!result.converged)
    throw std::runtime_error(fmt::format("mobility of {} spheres without a matrix: error {:.3g} after {} iterations",
                                         size(), result.error, result.iterations));
  iterations_ = result.iterations;
  return result.solution;
}

}  // namespace crumble
