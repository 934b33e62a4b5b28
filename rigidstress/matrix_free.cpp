#include "rigidstress/matrix_free.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace crumble {

MatrixFreeFarField::MatrixFreeFarField(const Spheres& spheres, double viscosity, double tolerance,
                                       std::function<void(int, int, int)> heard)
    : Hydrodynamics(spheres, viscosity),
      sum_(reduced()),
      tolerance_(tolerance),
      heard_(std::move(heard)),
      inverse_diagonal_(11 * size()) {
  for (int i = 0; i < size(); ++i) {
    const SelfMobility self(reduced().radius[i]);
    inverse_diagonal_.segment<5>(5 * i).setConstant(1 / self.stresslet);
    inverse_diagonal_.segment<3>(5 * size() + 6 * i).setConstant(1 / self.force);
    inverse_diagonal_.segment<3>(5 * size() + 6 * i + 3).setConstant(1 / self.torque);
  }
}

Eigen::VectorXd MatrixFreeFarField::solve(const Eigen::VectorXd& w, int& iterations) const {
  constexpr int most = 2000;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(w.size()), r = w, product(w.size());
  Eigen::VectorXd z = inverse_diagonal_.cwiseProduct(r), p = z;
  double rho = r.dot(z);
  const double goal = tolerance_ * tolerance_ * rho;
  for (iterations = 0; iterations < most && rho > goal; ++iterations) {
    sum_.apply(p.data(), product.data());
    const double alpha = rho / p.dot(product);
    q += alpha * p;
    r -= alpha * product;
    z = inverse_diagonal_.cwiseProduct(r);
    const double next = r.dot(z);
    p = z + next / rho * p;
    rho = next;
  }
  if (!(rho <= goal))
    throw std::runtime_error(
        fmt::format("conjugate gradients on the mobility of {} spheres did not converge in {} "
                    "iterations",
                    size(), most));
  return q;
}

void MatrixFreeFarField::solve_resistance(const Eigen::MatrixXd& w_motion, const Eigen::MatrixXd& w_strain,
                                          Eigen::MatrixXd& q_motion, Eigen::MatrixXd& q_strain) const {
  const auto columns = static_cast<int>(w_motion.cols());
  q_motion.resize(6 * size(), columns);
  q_strain.resize(5 * size(), columns);
  for (int c = 0; c < columns; ++c) {
    Eigen::VectorXd w(11 * size());
    w << w_strain.col(c), w_motion.col(c);
    int iterations = 0;
    const Eigen::VectorXd q = solve(w, iterations);
    q_strain.col(c) = q.head(5 * size());
    q_motion.col(c) = q.tail(6 * size());
    if (heard_) heard_(c, columns, iterations);
  }
}

void MatrixFreeFarField::solve_mobility(const Eigen::MatrixXd&, const Eigen::MatrixXd&, Eigen::MatrixXd&,
                                        Eigen::MatrixXd&) const {
  throw std::logic_error("MatrixFreeFarField solves for loads only");
}

}  // namespace crumble
