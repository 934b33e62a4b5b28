// The continuum model of drying: point particles that diffuse while the surface sweeps them up.
#pragma once

#include <cstdint>
#include <vector>

namespace crumble::dryer {

//   dC/dt = D r^-2 d/dr(r^2 dC/dr)                                                        (paper, Eq. 25)
//   dC/dr = 0 at r = 0                                                                    (paper, Eq. 26)
//   v C - D dC/dr = 0 at r = R(t)                                                         (paper, Eq. 27)
// With Gamma = C/C0 against rho = r/R(t) and theta = k t/R0^2, and Pe = k/D, whose inverse the paper calls "D/k":
//   dGamma/dtheta = [-(rho/2) dGamma/drho + (1/Pe) rho^-2 d/drho(rho^2 dGamma/drho)] / (1 - theta)   (paper, Eq. 28)
//   dGamma/drho = (Pe/2) Gamma at rho = 1                                                 (paper, Eq. 29)
//   Gamma = 1 at theta = 0                                                                (paper, Eq. 30)
// With g = Gamma (1 - theta)^(3/2) and s = -ln(1 - theta) this is a conservation law of constant coefficients,
//   dg/ds = rho^-2 d/drho {rho^2 [(1/Pe) dg/drho - (rho/2) g]},  no flux at rho = 0 and rho = 1,
// which keeps the integral of g rho^2 = 1/3 and ends at g ~ exp(Pe rho^2/4).
//
// Finite volumes on a mesh that is fine at the wall, with exponentially fitted fluxes (Scharfetter & Gummel 1969:
// second order, positive for any cell). In time TR-BDF2 (Bank et al. 1985): second order, L-stable; steps by
// its error estimate, small at first, where the start contradicts the condition at the wall (Gamma(1) ~ 1 + sqrt(Pe
// theta/pi)).
class Continuum {
 public:
  struct Control {
    int cells = 4000;
    double tolerance = 1e-10;  // of one time step, relative to the largest g
  };

  // Throws std::domain_error unless 0 < peclet <= largest_peclet.
  Continuum(double peclet, const Control& control);
  static constexpr double largest_peclet = 1e4;

  // To a later theta < 1.
  void advance_to(double theta);
  // One time step in s, of whatever error; returns the estimate of it.
  double step(double ds);

  double theta() const;
  std::int64_t steps() const { return steps_; }

  // Gamma at 0 <= rho <= 1.
  double concentration(double rho) const;
  // Fraction of all particles within rho; 1 at rho = 1 but for the defect of the conservation of mass.
  double fraction_within(double rho) const;

  const std::vector<double>& faces() const { return face_; }  // of the cells, from 0 to 1

 private:
  using Profile = std::vector<double>;

  void make_mesh(int cells);
  void make_fluxes();
  Profile rate(const Profile& g) const;
  void factor(double c);
  void solve(Profile& rhs) const;

  double peclet_, tolerance_, s_ = 0, next_step_;
  std::int64_t steps_ = 0;
  Profile face_, center_, volume_;
  Profile from_left_, from_right_;  // flux through face f to the right: from_left[f] g[f-1] - from_right[f] g[f]
  Profile g_;
  double factored_ = -1;
  Profile lower_, diagonal_, upper_;  // of the factor of 1 - c A
};

struct ContinuumProfile {
  double theta = 0;
  std::vector<double> rho, gamma;  // from the centre to the wall
  double error = 0;        // of gamma, estimated: a third of the difference to half the cells and half the steps
  double mass_defect = 0;  // relative change of the number of particles
};

// Profiles at increasing 0 <= theta < 1. Throws std::domain_error naming what is out of range.
std::vector<ContinuumProfile> continuum_profiles(double peclet, const std::vector<double>& theta);

}  // namespace crumble::dryer
