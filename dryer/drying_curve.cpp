#include "dryer/drying_curve.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace crumble::dryer {

namespace {

// Cubic through f0, f1 with slopes s0, s1 an interval `dt` apart, at the fraction x of it; in the form that gives a
// straight line to rounding.
double cubic(double f0, double s0, double f1, double s1, double dt, double x) {
  const double mean = (f1 - f0) / dt;
  return f0 + x * dt * (mean + (1 - x) * ((1 - x) * (s0 - mean) - x * (s1 - mean)));
}

}  // namespace

DryingCurve::DryingCurve(std::vector<Node> nodes) : nodes_(std::move(nodes)) {
  if (nodes_.size() < 2 || nodes_.front().time != 0 || nodes_.back().square != 0)
    throw std::invalid_argument("a drying curve begins at time 0 and ends at radius 0");
  for (std::size_t k = 1; k < nodes_.size(); ++k)
    if (!(nodes_[k].time > nodes_[k - 1].time)) throw std::invalid_argument("times of a drying curve must increase");
  turn_ = nodes_.size() - 1;
  while (turn_ > 0 && nodes_[turn_ - 1].square > nodes_[turn_].square) --turn_;
}

std::size_t DryingCurve::interval(double time) const {
  const auto after =
      std::upper_bound(nodes_.begin(), nodes_.end(), time, [](double t, const Node& node) { return t < node.time; });
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - nodes_.begin(), 1, std::ssize(nodes_) - 1)) - 1;
}

double DryingCurve::square(std::size_t k, double time) const {
  const Node &a = nodes_[k], &b = nodes_[k + 1];
  const double dt = b.time - a.time;
  return cubic(a.square, a.square_slope, b.square, b.square_slope, dt, (time - a.time) / dt);
}

double DryingCurve::radius(double time) const {
  if (time >= lifetime()) return 0;
  return std::sqrt(std::max(square(interval(time), std::max(time, 0.0)), 0.0));
}

double DryingCurve::temperature(double time) const {
  if (time >= lifetime()) return nodes_.back().temperature;
  const std::size_t k = interval(time);
  const Node &a = nodes_[k], &b = nodes_[k + 1];
  const double dt = b.time - a.time;
  return cubic(a.temperature, a.warming, b.temperature, b.warming, dt, (std::max(time, 0.0) - a.time) / dt);
}

double DryingCurve::time_at(double R) const {
  const double wanted = R * R;
  if (!(wanted > 0)) return lifetime();
  if (wanted >= nodes_[turn_].square) return nodes_[turn_].time;
  const auto below = std::upper_bound(nodes_.begin() + static_cast<std::ptrdiff_t>(turn_), nodes_.end(), wanted,
                                      [](double s, const Node& node) { return s > node.square; });
  const auto k = static_cast<std::size_t>(below - nodes_.begin()) - 1;
  // Regula falsi (Illinois): at once where R^2 is straight.
  double low = nodes_[k].time, high = nodes_[k + 1].time;
  double above = nodes_[k].square - wanted, under = nodes_[k + 1].square - wanted;
  for (int step = 0; step < 100 && high - low > 1e-15 * high; ++step) {
    const double middle = low + (high - low) * above / (above - under);
    const double left = square(k, middle) - wanted;
    if (std::abs(left) <= 1e-15 * wanted) return middle;
    if (left > 0) {
      low = middle, above = left, under /= 2;
    } else {
      high = middle, under = left, above /= 2;
    }
  }
  return low;
}

double DryingCurve::front_speed(double R) const {
  const double time = time_at(R);
  const std::size_t k = interval(time);
  const Node &a = nodes_[k], &b = nodes_[k + 1];
  const double dt = b.time - a.time, x = std::min((time - a.time) / dt, 1.0), mean = (b.square - a.square) / dt;
  const double slope =
      mean + (1 - x) * (1 - 3 * x) * (a.square_slope - mean) + x * (3 * x - 2) * (b.square_slope - mean);
  return -slope / (2 * R);
}

DryingCurve DryingCurve::scaled(double size, double pace) const {
  std::vector<Node> nodes = nodes_;
  for (Node& n : nodes) {
    n.time *= pace, n.warming /= pace;
    n.square *= size * size, n.square_slope *= size * size / pace;
  }
  return DryingCurve(std::move(nodes));
}

}  // namespace crumble::dryer
