// Coefficients of a stabilised explicit step.
#pragma once

#include <vector>

namespace crumble::dryer {

// The damped Runge-Kutta-Chebyshev method of first order: s evaluations of f make a step of dx/dt = f(x) as long as
// 0.96 s^2/rate, where s steps of Euler's method would reach 2 s/rate; rate: largest eigenvalue of -df/dx, 1/s. With
// T_j the Chebyshev polynomials, b_j = 1/T_j(w0), w0 = 1 + 2/s^2 and w1 = T_s(w0)/T'_s(w0), the increments of x are
//
//   D_j = m_j D_(j-1) + p_j dt f(x_(j-1), t + c_(j-1) dt),   m_j = b_j/b_(j-2),   p_j = 2 w1 b_j/b_(j-1)
//
// with D_0 = 0, m_1 = 0 and p_1 = w1 b_1: steps with memory. x_j is a solution at t + c_j dt, c_s = 1. What is faster
// than the step falls by 1/cosh(2) = 0.27 in it; the usual method leaves 0.95 and is stable over twice the length.
// Source: van der Houwen & Sommeijer 1980; Verwer, Hundsdorfer & Sommeijer 1990.
struct Chebyshev {
  explicit Chebyshev(int stages);
  // Stages for a step of dt.
  static int stages(double dt, double rate);

  struct Stage {
    double memory, push, time;  // m_j, p_j, c_(j-1)
  };
  std::vector<Stage> stage;     // j - 1
  std::vector<double> reached;  // c_j
};

}  // namespace crumble::dryer
