// Thermal force and torque that stand for a while: Brownian motion as a broken line.
#pragma once

#include <cstdint>
#include <vector>

#include "dryer/brownian_path.hpp"
#include "dryer/model.hpp"
#include "dryer/six_vector.hpp"

namespace crumble::dryer {

// The loads of Eqs. 4 and 5 with normal numbers, of variance 2 kT zeta/T and 2 kT zeta_r/T on each component, constant
// for intervals of a length T:
//   - a free particle, and any cluster that moves as a rigid body, is displaced by 2 D t in all whole intervals,
//   exactly
//   - what is held by a spring k with m = k/zeta leaves its fluctuations as kT/k tanh(m T/2)/(m T/2): slow motion has
//     its share of kT, motion much faster than T has none. So a bond feels no more than a force that is small against
//     its pull-off force, and never more than sqrt(kT k)
// Source: Wong & Zakai 1965 (noise is additive: no drift is missing).
//
// T is the time in which the smallest particle diffuses `displacement` radii (root mean square).
class ThermalLoads {
 public:
  ThermalLoads(const DryingModel& model, const std::vector<double>& radius, std::uint64_t seed, double displacement);
  static double interval(const DryingModel& model, double a, double displacement);  // T, s

  // Rate at which the surface catches a particle that the noise drives into it, where that is faster than the front at
  // R: surface_rate() for the standard deviation of a component of the velocity, sqrt(2 D/T), 1/s.
  static double surface_rate(const DryingModel& model, double a, double interval, double R);

  // Goes on to the interval in which `time` lies. A function of seed and time alone.
  void advance_to(double time);
  // Of the interval, or of one later, s.
  double end(std::uint64_t later = 0) const { return interval_ * static_cast<double>(index_ + 1 + later); }
  double interval() const { return interval_; }
  double displacement() const { return displacement_; }
  // On a particle in the liquid, N and N m; and the velocity that the force gives it, m/s.
  SixVector load(std::size_t particle) const;
  Vector3 velocity(std::size_t particle) const;

 private:
  double random(std::size_t component, std::size_t particle) const {
    return static_cast<double>(normal_[component * stride_ + particle]);
  }
  double displacement_, interval_;
  BrownianPath path_;
  std::uint64_t index_ = 0;
  std::size_t stride_;
  std::vector<std::uint32_t> particle_;
  std::vector<double> force_, torque_, drag_;  // standard deviations, N and N m; N s/m
  std::vector<float> normal_;
};

}  // namespace crumble::dryer
