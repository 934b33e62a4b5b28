// R(t) and T(t) of a droplet in a gas, in place of Eq. 7.
#pragma once

#include <vector>

namespace crumble::dryer {

// Cubic between instants at which R^2, T and their slopes are known (Hermite), so R^2 is linear to rounding where its
// slope is constant. R^2 may rise at first, where vapour condenses on a cold droplet; then it falls to 0.
class DryingCurve {
 public:
  struct Node {
    double time = 0;                      // s
    double square = 0, square_slope = 0;  // R^2, m^2; m^2/s
    double temperature = 0, warming = 0;  // T, K; K/s
  };

  // Times ascending from 0; at the last R^2 = 0. Throws std::invalid_argument on others.
  explicit DryingCurve(std::vector<Node> nodes);

  double radius(double time) const;       // m; 0 at the end and after it
  double temperature(double time) const;  // K; that of the end after it
  double time_at(double R) const;         // the last instant with this radius, s; 0 if R was never so large
  double front_speed(double R) const;     // -dR/dt when the front is at R the last time, m/s
  double lifetime() const { return nodes_.back().time; }
  const std::vector<Node>& nodes() const { return nodes_; }

  // The same course in a droplet whose lengths are `size` and whose times are `pace` times those of this one.
  DryingCurve scaled(double size, double pace) const;

 private:
  std::size_t interval(double time) const;
  double square(std::size_t interval, double time) const;

  std::vector<Node> nodes_;
  std::size_t turn_;  // from this node on R^2 falls
};

}  // namespace crumble::dryer
