#include "dryer/continuum.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace crumble::dryer {

namespace {

// z/(e^z - 1).
double bernoulli(double z) { return std::abs(z) < 1e-10 ? 1 - z / 2 : z / std::expm1(z); }

double cube(double x) { return x * x * x; }

// Mean of rho^2 over the shell between a and b.
double mean_square(double a, double b) { return 0.6 * (cube(b) * b * b - cube(a) * a * a) / (cube(b) - cube(a)); }

}  // namespace

Continuum::Continuum(double peclet, const Control& control) : peclet_(peclet), tolerance_(control.tolerance) {
  if (!(peclet > 0 && peclet <= largest_peclet))
    throw std::domain_error(
        fmt::format("the Peclet number must be above 0 and at most {:g}; it is {:g}", largest_peclet, peclet));
  make_mesh(control.cells);
  make_fluxes();
  g_.assign(center_.size(), 1);
  // The first step moves the concentration of the cell at the wall by about the root of the tolerance.
  next_step_ = 1e-3 * std::min(peclet_, 1.0) * std::pow(1 - face_[face_.size() - 2], 2);
}

// The cells shrink geometrically towards the wall, where the layer is 2/Pe thick in the end.
void Continuum::make_mesh(int cells) {
  const double ratio = std::log(20 + 2 * peclet_);
  for (int f = 0; f <= cells; ++f)
    face_.push_back(1 - std::expm1(ratio * (1 - static_cast<double>(f) / cells)) / std::expm1(ratio));
  face_.front() = 0;
  for (int c = 0; c < cells; ++c) {
    center_.push_back((face_[c] + face_[c + 1]) / 2);
    volume_.push_back((cube(face_[c + 1]) - cube(face_[c])) / 3);
  }
}

void Continuum::make_fluxes() {
  from_left_.assign(face_.size(), 0);  // stays 0 at the centre and at the wall
  from_right_ = from_left_;
  for (std::size_t f = 1; f + 1 < face_.size(); ++f) {
    const double distance = center_[f] - center_[f - 1];
    const double z = peclet_ / 2 * face_[f] * distance;
    const double conductance = face_[f] * face_[f] / (peclet_ * distance);
    from_left_[f] = conductance * bernoulli(-z);
    from_right_[f] = conductance * bernoulli(z);
  }
}

Continuum::Profile Continuum::rate(const Profile& g) const {
  Profile rate(g.size());
  double in = 0;
  for (std::size_t c = 0; c < g.size(); ++c) {
    const double out = c + 1 < g.size() ? from_left_[c + 1] * g[c] - from_right_[c + 1] * g[c + 1] : 0;
    rate[c] = (in - out) / volume_[c];
    in = out;
  }
  return rate;
}

// L U of 1 - c A, A the tridiagonal matrix of rate(); it is an M-matrix and needs no pivots.
void Continuum::factor(double c) {
  if (c == factored_) return;
  const std::size_t n = g_.size();
  lower_.assign(n, 0), diagonal_.assign(n, 0), upper_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const double scale = c / volume_[i];
    diagonal_[i] = 1 + scale * (from_right_[i] + from_left_[i + 1]);
    upper_[i] = -scale * from_right_[i + 1];
    if (i == 0) continue;
    lower_[i] = -scale * from_left_[i] / diagonal_[i - 1];
    diagonal_[i] -= lower_[i] * upper_[i - 1];
  }
  factored_ = c;
}

void Continuum::solve(Profile& x) const {
  for (std::size_t i = 1; i < x.size(); ++i) x[i] -= lower_[i] * x[i - 1];
  x.back() /= diagonal_.back();
  for (std::size_t i = x.size() - 1; i-- > 0;) x[i] = (x[i] - upper_[i] * x[i + 1]) / diagonal_[i];
}

double Continuum::step(double ds) {
  static const double gamma = 2 - std::sqrt(2.0);
  static const double k = (-3 * gamma * gamma + 4 * gamma - 2) / (12 * (2 - gamma));
  const double c = gamma / 2 * ds;
  factor(c);
  // Solved for the changes of g, not for g: round-off then costs no mass.
  const Profile rate0 = rate(g_);
  Profile change(g_.size());
  for (std::size_t i = 0; i < g_.size(); ++i) change[i] = 2 * c * rate0[i];
  solve(change);
  Profile middle(g_), end(g_), error(g_.size());
  for (std::size_t i = 0; i < g_.size(); ++i) middle[i] += change[i];
  for (std::size_t i = 0; i < g_.size(); ++i) change[i] = change[i] / (gamma * (2 - gamma)) + c * rate0[i];
  solve(change);
  for (std::size_t i = 0; i < g_.size(); ++i) end[i] += change[i];
  const Profile rate1 = rate(middle), rate2 = rate(end);
  for (std::size_t i = 0; i < g_.size(); ++i)
    error[i] = 2 * k * ds * (rate0[i] / gamma - rate1[i] / (gamma * (1 - gamma)) + rate2[i] / (1 - gamma));
  solve(error);  // what the stiff modes overstate
  double largest = 0, size = 0;
  for (std::size_t i = 0; i < g_.size(); ++i) {
    largest = std::max(largest, std::abs(error[i]));
    size = std::max(size, std::abs(end[i]));
  }
  g_.swap(end);
  s_ += ds;
  ++steps_;
  return largest / size;
}

double Continuum::theta() const { return -std::expm1(-s_); }

void Continuum::advance_to(double theta) {
  const double goal = -std::log1p(-theta);
  while (s_ < goal) {
    const double left = goal - s_, start = s_;
    // Two equal steps rather than one and a sliver.
    const double ds = next_step_ >= left ? left : std::min(next_step_, left / 2);
    const Profile before = g_;
    const double error = step(ds);
    const double factor = std::clamp(0.9 * std::cbrt(tolerance_ / std::max(error, 1e-300)), 0.2, 2.0);
    if (error > tolerance_) {
      g_ = before;
      s_ = start;
      --steps_;
      next_step_ = factor * ds;
      continue;
    }
    if (ds == left) s_ = goal;
    // A step cut short by the goal says little about the next.
    next_step_ = std::max(factor * ds, ds < next_step_ ? next_step_ : 0);
  }
}

// Linear in rho^2, which has no slope at the centre; in the last half cell g exp(-Pe rho^2/4), which has none at the
// wall. Cell values are means, so that a cell counts at its mean rho^2.
double Continuum::concentration(double rho) const {
  const auto above = static_cast<std::size_t>(std::upper_bound(center_.begin(), center_.end(), rho) - center_.begin());
  const std::size_t i = std::clamp<std::size_t>(above, 1, center_.size() - 1) - 1;
  const double q0 = mean_square(face_[i], face_[i + 1]), q1 = mean_square(face_[i + 1], face_[i + 2]), q = rho * rho;
  const double fit = above == center_.size() ? peclet_ / 4 : 0;
  const double g0 = g_[i] * std::exp(fit * (q - q0)), g1 = g_[i + 1] * std::exp(fit * (q - q1));
  return (g0 + (q - q0) / (q1 - q0) * (g1 - g0)) * std::exp(1.5 * s_);
}

double Continuum::fraction_within(double rho) const {
  double within = 0;
  for (std::size_t c = 0; c < g_.size() && face_[c] < rho; ++c)
    within += 3 * g_[c] * (face_[c + 1] <= rho ? volume_[c] : (cube(rho) - cube(face_[c])) / 3);
  return within;
}

std::vector<ContinuumProfile> continuum_profiles(double peclet, const std::vector<double>& theta) {
  constexpr int rows = 200;
  double before = 0;
  for (const double t : theta) {
    if (!(t >= 0 && t < 1)) throw std::domain_error(fmt::format("theta must be at least 0 and below 1; it is {:g}", t));
    if (t < before) throw std::domain_error(fmt::format("theta must increase; {:g} stands behind {:g}", t, before));
    before = t;
  }
  const Continuum::Control control;
  // Half the cells, and about half the steps in time.
  Continuum fine(peclet, control), coarse(peclet, {control.cells / 2, 8 * control.tolerance});
  std::vector<ContinuumProfile> profiles;
  for (const double t : theta) {
    fine.advance_to(t);
    coarse.advance_to(t);
    ContinuumProfile profile{t, {}, {}, 0, fine.fraction_within(1) - 1};
    for (int row = 0; row <= rows; ++row) {
      const double rho = fine.faces()[static_cast<std::size_t>(row * control.cells / rows)];
      profile.rho.push_back(rho);
      profile.gamma.push_back(fine.concentration(rho));
      // Both are of second order: the difference is three times the error of the finer one.
      const double error = std::abs(profile.gamma.back() - coarse.concentration(rho)) / 3;
      profile.error = std::max(profile.error, error);
    }
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace crumble::dryer
