#include "dryer/continuum.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

using namespace crumble;
using namespace crumble::dryer;

namespace {

// Nodes and weights of Gauss-Legendre quadrature on 0 ... 1 (Golub & Welsch 1969).
struct Quadrature {
  Eigen::VectorXd node, weight;
};

Quadrature gauss_legendre(int n) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (int k = 1; k < n; ++k) jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(jacobi);
  return {(solver.eigenvalues().array() + 1) / 2, solver.eigenvectors().row(0).array().square()};
}

// Legendre polynomials P_0, P_2, ... at rho, and their slopes.
void even_legendre(double rho, Eigen::VectorXd& value, Eigen::VectorXd& slope) {
  double before = 1, p = rho, dbefore = 0, dp = 1;  // P_0, P_1
  value[0] = 1, slope[0] = 0;
  for (int k = 1; k < 2 * value.size() - 1; ++k) {
    const double next = ((2 * k + 1) * rho * p - k * before) / (k + 1), dnext = dbefore + (2 * k + 1) * p;
    before = p, p = next, dbefore = dp, dp = dnext;
    if (k % 2 == 1) value[(k + 1) / 2] = p, slope[(k + 1) / 2] = dp;
  }
}

// Gamma by another method: Galerkin with even Legendre polynomials, exact in time by the matrix exponential. The
// coefficients of the fast modes, which the start at the wall excites, have died out at the theta of the tests.
std::function<double(double)> galerkin(double peclet, double theta, int modes) {
  const Quadrature q = gauss_legendre(3 * modes);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(modes, modes), stiffness = mass;
  Eigen::VectorXd start = Eigen::VectorXd::Zero(modes), p(modes), dp(modes);
  for (int k = 0; k < q.node.size(); ++k) {
    const double rho = q.node[k], w = q.weight[k] * rho * rho;
    even_legendre(rho, p, dp);
    mass += w * p * p.transpose();
    stiffness += w * dp * (dp / peclet - rho / 2 * p).transpose();
    start += w * p;
  }
  const Eigen::LDLT<Eigen::MatrixXd> solver(mass);
  const double s = -std::log1p(-theta);
  const Eigen::MatrixXd propagator = (-s * solver.solve(stiffness)).eval().exp();
  const Eigen::VectorXd c = std::exp(1.5 * s) * propagator * solver.solve(start);
  return [c](double rho) {
    Eigen::VectorXd value(c.size()), slope(c.size());
    even_legendre(rho, value, slope);
    return c.dot(value);
  };
}

Continuum at(double peclet, double theta, const Continuum::Control& control) {
  Continuum model(peclet, control);
  model.advance_to(theta);
  return model;
}

// The reference values of Pe = 1, theta = 0.4, rounded to five decimals.
TEST(Continuum, has_the_known_values_at_peclet_1) {
  const auto profile = continuum_profiles(1, {0.4}).front();
  EXPECT_NEAR(profile.gamma.front(), 1.84803, 0.501e-5);
  EXPECT_NEAR(profile.gamma.back(), 2.37290, 0.501e-5);
  EXPECT_EQ(profile.rho.front(), 0);
  EXPECT_EQ(profile.rho.back(), 1);
}

// At Pe = 10 the Galerkin series of 24 modes is converged to 1e-9.
TEST(Continuum, agrees_with_a_spectral_solution_within_its_stated_error) {
  for (const double peclet : {0.1, 1.0, 10.0}) {
    const auto profile = continuum_profiles(peclet, {0.2, 0.4}).back();
    const auto exact = galerkin(peclet, 0.4, 24);
    EXPECT_LT(profile.error, 1e-6) << peclet;
    for (std::size_t row = 0; row < profile.rho.size(); ++row)
      EXPECT_NEAR(profile.gamma[row], exact(profile.rho[row]), std::max(1.2 * profile.error, 1e-8))
          << "Pe " << peclet << " rho " << profile.rho[row];
  }
}

TEST(Continuum, keeps_the_number_of_particles) {
  // Round-off alone; 1e-10 is what is promised.
  for (const double peclet : {1e-3, 1.0, 1000.0})
    for (const double theta : {1e-6, 0.4, 0.999})
      EXPECT_NEAR(at(peclet, theta, {500, 1e-8}).fraction_within(1), 1, 1e-12) << peclet << " " << theta;
}

TEST(Continuum, is_of_second_order_in_the_mesh) {
  const auto exact = galerkin(2, 0.4, 24);
  for (const double rho : {0.0, 1.0}) {
    const double coarse = at(2, 0.4, {100, 1e-11}).concentration(rho) - exact(rho);
    const double fine = at(2, 0.4, {200, 1e-11}).concentration(rho) - exact(rho);
    EXPECT_NEAR(coarse / fine, 4, 0.2) << rho;  // the next order is 1/N^2 smaller, time adds 1e-8 of 1e-5
  }
}

TEST(Continuum, is_of_second_order_in_the_time_step) {
  // From a smooth state on; the reference has 64 times as many steps.
  const auto error = [](int steps) {
    const auto later = [](int n) {
      Continuum model = at(2, 0.2, {200, 1e-9});
      for (int step = 0; step < n; ++step) model.step(0.3 / n);
      return model.concentration(1);
    };
    return later(steps) - later(64 * steps);
  };
  EXPECT_NEAR(error(5) / error(10), 4, 0.5);  // the next order is a tenth at these steps
}

TEST(Continuum, an_eighth_of_the_tolerance_takes_twice_the_steps) {
  const auto steps = [](double tolerance) { return static_cast<double>(at(1, 0.4, {200, tolerance}).steps()); };
  EXPECT_NEAR(steps(1e-9 / 8) / steps(1e-9), 2, 0.1);
}

// Fast diffusion: Gamma (1 - theta)^(3/2) = 1 + Pe (rho^2/4 - 3/20) + O(Pe^2), O(Pe^2) < 0.1 Pe^2.
TEST(Continuum, small_peclet_numbers_give_the_quasi_steady_profile) {
  const double peclet = 1e-3;
  const Continuum model = at(peclet, 0.5, {500, 1e-9});
  for (const double rho : {0.0, 0.3, 0.8, 1.0})
    EXPECT_NEAR(model.concentration(rho) * std::pow(0.5, 1.5), 1 + peclet * (rho * rho / 4 - 0.15),
                0.1 * peclet * peclet + 1e-8)
        << rho;
}

TEST(Continuum, the_final_profile_is_exponential_in_the_square_of_the_radius) {
  const Continuum model = at(4, 1 - 1e-9, {1000, 1e-9});
  for (const double rho : {0.0, 0.5, 1.0})
    EXPECT_NEAR(std::log(model.concentration(rho) / model.concentration(0)), rho * rho, 1e-5) << rho;
}

// The layer at the wall is thin and takes up what the front sweeps: Gamma(1) = 1 + sqrt(Pe theta/pi) + O(Pe theta).
TEST(Continuum, the_concentration_at_the_wall_starts_as_the_root_of_time) {
  for (const double theta : {1e-5, 1e-4})
    EXPECT_NEAR((at(10, theta, {4000, 1e-9}).concentration(1) - 1) / std::sqrt(10 * theta / std::numbers::pi), 1,
                2 * std::sqrt(10 * theta))
        << theta;
}

// Nothing but a shell: the middle keeps the concentration of the start until diffusion arrives.
TEST(Continuum, large_peclet_numbers_leave_the_middle_alone) {
  for (const double peclet : {100.0, Continuum::largest_peclet}) {
    const auto profile = continuum_profiles(peclet, {0.4}).front();
    EXPECT_NEAR(profile.gamma.front(), 1, 1e-6);
    EXPECT_LT(profile.error / profile.gamma.back(), 1e-6) << peclet;
    for (std::size_t row = 1; row < profile.gamma.size(); ++row)
      EXPECT_GT(profile.gamma[row], profile.gamma[row - 1] - 1e-6) << row;  // no oscillation at the layer
  }
}

TEST(Continuum, the_start_is_uniform) {
  const auto profile = continuum_profiles(5, {0}).front();
  // The value at the wall is continued over half a cell with the slope that the condition there demands.
  for (const double gamma : profile.gamma) EXPECT_NEAR(gamma, 1, 1e-8);
}

TEST(Continuum, what_it_cannot_solve_is_refused) {
  EXPECT_THROW(continuum_profiles(0, {0.4}), std::domain_error);
  EXPECT_THROW(continuum_profiles(-1, {0.4}), std::domain_error);
  EXPECT_THROW(continuum_profiles(1e6, {0.4}), std::domain_error);
  EXPECT_THROW(continuum_profiles(NAN, {0.4}), std::domain_error);
  EXPECT_THROW(continuum_profiles(1, {1}), std::domain_error);
  EXPECT_THROW(continuum_profiles(1, {-0.1}), std::domain_error);
  EXPECT_THROW(continuum_profiles(1, {NAN}), std::domain_error);
  EXPECT_THROW(continuum_profiles(1, {0.4, 0.2}), std::domain_error);
}

}  // namespace
