#include "common/hydro/matrix_free.hpp"

#include <fmt/format.h>

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <stdexcept>

#include "common/hydro/krylov.hpp"

namespace crumble {

namespace {

struct Cholesky : Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> {
  Cholesky() {
    cholmod().nmethods = 1;
    cholmod().method[0].ordering = CHOLMOD_METIS;
    cholmod().postorder = 1;
    cholmod().print = 0;
  }
};

}  // namespace

// With M replaced by its diagonal: f_strain = w/m, (1/m + D) u = b, f_motion = u/m.
struct MatrixFreeHydrodynamics::NearField {
  Eigen::VectorXd drag;  // 1/m of stresslets, then of forces and torques
  Eigen::SparseMatrix<double> matrix;
  Cholesky factor;

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
    : Hydrodynamics(spheres, viscosity),
      settings_(settings),
      sum_(reduced()),
      lubrication_(lubrication(reduced(), model)) {
  if (model.rung == Rung::multipole)
    throw std::invalid_argument("hydrodynamics without a matrix is for the far-field rungs, not for multipoles");
}

MatrixFreeHydrodynamics::~MatrixFreeHydrodynamics() = default;

Eigen::VectorXd MatrixFreeHydrodynamics::product(const Eigen::VectorXd& f) const {
  Eigen::VectorXd w(f.size());
  sum_.apply(f.data(), w.data());
  return w;
}

void MatrixFreeHydrodynamics::heard(Eigen::Index column, Eigen::Index columns, int iterations) const {
  if (settings_.heard) settings_.heard(static_cast<int>(column), static_cast<int>(columns), iterations);
}

Eigen::VectorXd MatrixFreeHydrodynamics::conjugate_gradients(const Eigen::VectorXd& w) const {
  iterations_ = 0;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(w.size()), r = w, z = inverse_->apply(r), p = z;
  double rho = r.dot(z);
  const double goal = settings_.tolerance * settings_.tolerance * rho;
  for (; rho > goal && iterations_ < settings_.limit; ++iterations_) {
    const Eigen::VectorXd Mp = product(p);
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

void MatrixFreeHydrodynamics::solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain,
                                               Eigen::MatrixXd& q_motion, Eigen::MatrixXd& q_strain) const {
  const int n = size();
  if (!inverse_) inverse_ = std::make_unique<SparseInverse>(reduced(), settings_.neighbours);
  q_motion.resize(6 * n, w_motion.cols());
  q_strain.resize(5 * n, w_motion.cols());
  int most = 0;
  for (Eigen::Index c = 0; c < w_motion.cols(); ++c) {
    Eigen::VectorXd w(11 * n);
    w << w_strain.col(c), w_motion.col(c);
    const Eigen::VectorXd q = conjugate_gradients(w);
    q_strain.col(c) = q.head(5 * n);
    q_motion.col(c) = q.tail(6 * n);
    most = std::max(most, iterations_);
    heard(c, w_motion.cols(), iterations_);
  }
  iterations_ = most;
  lubrication_.add(w_motion, w_strain, q_motion, q_strain);
}

void MatrixFreeHydrodynamics::solve_mobility(const Eigen::MatrixXd& q_motion, const Eigen::MatrixXd& w_strain,
                                             Eigen::MatrixXd& w_motion, Eigen::MatrixXd& q_strain) const {
  const int n = size();
  if (!near_) near_ = std::make_unique<NearField>(reduced(), lubrication_);
  const Eigen::MatrixXd still = Eigen::MatrixXd::Zero(6 * n, q_motion.cols());
  Eigen::MatrixXd by_strain = still, stresslet = Eigen::MatrixXd::Zero(5 * n, q_motion.cols());
  lubrication_.add(still, w_strain, by_strain, stresslet);
  w_motion.resize(6 * n, q_motion.cols());
  q_strain.resize(5 * n, q_motion.cols());
  const auto apply = [&](const Eigen::VectorXd& f) {
    Eigen::VectorXd w = product(f);
    const Eigen::MatrixXd u = w.tail(6 * n), at_rest = Eigen::MatrixXd::Zero(5 * n, 1);
    Eigen::MatrixXd loads = f.tail(6 * n), unused = at_rest;
    lubrication_.add(u, at_rest, loads, unused);
    w.tail(6 * n) = loads;
    return w;
  };
  int most = 0;
  for (Eigen::Index c = 0; c < q_motion.cols(); ++c) {
    Eigen::VectorXd b(11 * n);
    b << w_strain.col(c), q_motion.col(c) - by_strain.col(c);
    const KrylovResult result = gmres(
        apply, [&](const Eigen::VectorXd& r) { return near_->apply(r); }, b, settings_.tolerance, settings_.limit);
    if (!result.converged)
      throw std::runtime_error(fmt::format("mobility of {} spheres without a matrix: error {:.3g} after {} iterations",
                                           n, result.error, result.iterations));
    w_motion.col(c) = product(result.solution).tail(6 * n);
    q_strain.col(c) = result.solution.head(5 * n);
    most = std::max(most, result.iterations);
    heard(c, q_motion.cols(), result.iterations);
  }
  iterations_ = most;
  lubrication_.add(w_motion, w_strain, by_strain, q_strain);
}

}  // namespace crumble
