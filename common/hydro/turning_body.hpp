// How the free body turns: its orientation in a flow, integrated with error control.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "common/hydro/linear_flow.hpp"

namespace crumble {

// Orientation R (quaternion q): body -> laboratory. With the gradient of the flow in the laboratory
//   Omega = omega_inf + R (drift . R^T E R),   dq/dt = (0, Omega) q/2
// (Sanchez Fellay, Twist & Vanni 2013). drift: lower three rows of RigidBodyResponse::drift.
class TurningBody {
 public:
  explicit TurningBody(const Eigen::Matrix<double, 3, 5>& drift, double tolerance = 1e-8)
      : drift_(drift), tolerance_(tolerance) {}

  static Vector5 strain_seen(const Quaternion& q, const Eigen::Matrix3d& gradient) {
    const Eigen::Matrix3d R = q.toRotationMatrix();
    return strain_components(R.transpose() * gradient * R);
  }

  Vector3 angular_velocity(const Quaternion& q, const Eigen::Matrix3d& gradient) const {
    const LinearFlow flow{Vector3::Zero(), gradient};
    return flow.angular_velocity() + q * Vector3(drift_ * strain_seen(q, gradient));
  }

  // From t to `end`. `step` is the first step to try and afterwards the one to go on with. Local error of a step below
  // the tolerance (Dormand & Prince 1980, orders 5 and 4). `gradient_at(t)` returns the gradient, 1/s.
  template <class GradientAt>
  void advance(Quaternion& q, double t, double end, double& step, const GradientAt& gradient_at) const {
    while (t < end) {
      const double dt = std::min(step, end - t);
      Quaternion next = q;
      const double error = try_step(next, t, dt, gradient_at) / tolerance_;
      if (error <= 1) {
        q = next.normalized();
        t = dt < end - t ? t + dt : end;
      }
      // The last step of an interval may be a short one: that says nothing about the next.
      const double wanted = dt * std::clamp(0.9 * std::pow(std::max(error, 1e-10), -0.2), 0.2, 5.0);
      step = error <= 1 && dt < step ? std::max(step, wanted) : wanted;
    }
  }

 private:
  Eigen::Matrix<double, 3, 5> drift_;
  double tolerance_;

  template <class GradientAt>
  double try_step(Quaternion& q, double t, double dt, const GradientAt& gradient_at) const {
    using Vector4 = Eigen::Vector4d;  // x, y, z, w as Eigen stores them
    static constexpr double c[7] = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
    static constexpr double a[7][6] = {{},
                                       {1. / 5},
                                       {3. / 40, 9. / 40},
                                       {44. / 45, -56. / 15, 32. / 9},
                                       {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                                       {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
                                       {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
    static constexpr double e[7] = {71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};
    std::array<Vector4, 7> k;
    const Vector4 y = q.coeffs();
    Vector4 at = y;
    for (int s = 0; s < 7; ++s) {
      at = y;
      for (int r = 0; r < s; ++r) at += dt * a[s][r] * k[r];
      Quaternion there;
      there.coeffs() = at;
      const Vector3 w = angular_velocity(there.normalized(), gradient_at(t + c[s] * dt));
      k[s] = 0.5 * (Quaternion(0, w.x(), w.y(), w.z()) * there).coeffs();
    }
    q.coeffs() = at;  // the last stage stands at the solution of fifth order
    Vector4 error = Vector4::Zero();
    for (int s = 0; s < 7; ++s) error += dt * e[s] * k[s];
    return error.norm();
  }
};

}  // namespace crumble
