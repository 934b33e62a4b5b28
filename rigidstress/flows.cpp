#include "rigidstress/flows.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include "common/numerics/noise.hpp"

namespace crumble {

Quaternion random_orientation(std::uint64_t seed, std::uint32_t number) {
  const auto q = random_normals(seed, Purpose::orientation, number, 0);
  return Quaternion(q[0], q[1], q[2], q[3]).normalized();
}

Eigen::Matrix3d planar_elongation_gradient() { return planar_elongation(1).gradient; }

Eigen::Matrix3d simple_shear_gradient() {
  Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
  g(0, 1) = 1;
  return g;
}

Eigen::Matrix3d uniaxial_gradient() { return Vector3(1, -0.5, -0.5).asDiagonal() * std::sqrt(1.0 / 3); }

Eigen::Matrix3d biaxial_gradient() { return Vector3(0.5, 0.5, -1).asDiagonal() * std::sqrt(1.0 / 3); }

Peak LoadedBody::peak(const Vector5& strain) const {
  Peak p;
  const Eigen::VectorXd n = tensions(strain);
  for (Eigen::Index b = 0; b < n.size(); ++b) {
    const double use = n[b] / pull_off[b];
    if (use > p.use) p = {static_cast<int>(b), n[b], use};
  }
  return p;
}

namespace {

// How fast the strain that the body sees changes. In an axisymmetric flow a chiral body may spin about the axis for
// ever and still be loaded steadily.
double unrest(const TurningBody& turning, const Quaternion& q, const Eigen::Matrix3d& gradient) {
  const Vector3 w = turning.angular_velocity(q, gradient);
  Eigen::Matrix3d W;
  W << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return (W * gradient - gradient * W).norm() / gradient.norm();
}

// Turns until the loads are steady. Near a fixed point the distance to it is this rate over the relaxation rate.
bool settle(const TurningBody& turning, const Eigen::Matrix3d& gradient, double longest, Quaternion& q) {
  constexpr double at_rest = 1e-9;  // of the shear rate
  double t = 0, step = 0.1, stretch = 2;
  while (t < longest) {
    if (unrest(turning, q, gradient) < at_rest) return true;
    turning.advance(q, t, t + stretch, step, [&](double) { return gradient; });
    t += stretch;
    stretch *= 1.2;
  }
  return unrest(turning, q, gradient) < at_rest;
}

bool same_loads(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  constexpr double resolution = 1e-3;  // an attractor approached slowly is known less well than its own rest
  return (a - b).cwiseAbs().maxCoeff() <= resolution * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
}

}  // namespace

StrainingResult straining(const LoadedBody& body, const Eigen::Matrix3d& gradient, const StrainingChoice& choice) {
  StrainingResult result;
  if (body.pull_off.empty()) return result;
  const WorstContact worst = worst_contact(body.response.tension, body.pull_off, gradient);
  result.worst = {worst.contact, worst.tension, worst.tension / body.pull_off[worst.contact]};
  result.worst_orientation =
      Quaternion(worst_orientation(body.response.tension.row(worst.contact).transpose(), gradient));
  // Rounding leaves a drift of about 1e-14 where symmetry forbids any.
  result.is_turning = body.response.drift.bottomRows<3>().cwiseAbs().maxCoeff() > 1e-9;

  const TurningBody turning = body.turning();
  std::vector<Eigen::VectorXd> loads;
  const double share = 1.0 / choice.starts;
  int settled = 0;
  for (int k = 0; k < choice.starts; ++k) {
    Quaternion q = random_orientation(choice.seed, static_cast<std::uint32_t>(k));
    if (!settle(turning, gradient, choice.longest_strain, q)) {
      result.unsettled += share;
      continue;
    }
    const Vector5 strain = TurningBody::strain_seen(q, gradient);
    const Peak peak = body.peak(strain);
    result.mean_settled_tension += peak.tension;
    ++settled;
    const Eigen::VectorXd n = body.tensions(strain);
    std::size_t m = 0;
    while (m < loads.size() && !same_loads(loads[m], n)) ++m;
    if (m == loads.size()) {
      loads.push_back(n);
      result.attractors.push_back({q, peak, 0});
    }
    result.attractors[m].share += share;
  }
  if (settled > 0) result.mean_settled_tension /= settled;
  // Not stable_sort: its buffer (GCC 12) ignores the alignment of quaternions.
  std::sort(result.attractors.begin(), result.attractors.end(), [&](const Attractor& a, const Attractor& b) {
    return std::abs(a.share - b.share) > 0.5 * share ? a.share > b.share : a.peak.use > b.peak.use;
  });
  return result;
}

Orbit follow(const LoadedBody& body, const Quaternion& start, const std::vector<double>& times,
             const std::function<Eigen::Matrix3d(double)>& gradient_at, double tolerance) {
  const TurningBody turning = body.turning(tolerance);
  Orbit orbit;
  orbit.time = times;
  Quaternion q = start;
  double step = times.size() > 1 ? times[1] - times[0] : 0, spin_before = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k > 0) turning.advance(q, times[k - 1], times[k], step, gradient_at);
    const Eigen::Matrix3d gradient = gradient_at(times[k]);
    const Peak peak = body.peak(TurningBody::strain_seen(q, gradient));
    orbit.orientation.push_back(q);
    orbit.max_tension.push_back(peak.tension);
    if (peak.use > orbit.peak.use) {
      orbit.peak = peak;
      orbit.peak_at = k;
    }
    const Vector3 vorticity = LinearFlow{Vector3::Zero(), gradient}.angular_velocity();
    const double rate = vorticity.norm();
    const double spin = rate > 0 ? turning.angular_velocity(q, gradient).dot(vorticity) / rate : 0;
    if (k > 0) {
      const double dt = times[k] - times[k - 1];
      orbit.turned += 0.5 * dt * (spin + spin_before);
      orbit.mean_max_tension += 0.5 * dt * (orbit.max_tension[k] + orbit.max_tension[k - 1]);
    }
    spin_before = spin;
  }
  const double duration = times.back() - times.front();
  orbit.mean_max_tension = duration > 0 ? orbit.mean_max_tension / duration : orbit.max_tension.front();
  return orbit;
}

ShearResult shear(const LoadedBody& body, const ShearChoice& choice) {
  ShearResult result;
  const Eigen::Matrix3d gradient = simple_shear_gradient();
  if (!body.pull_off.empty()) {
    const WorstContact worst = worst_contact(body.response.tension, body.pull_off, gradient);
    result.supremum = {worst.contact, worst.tension, worst.tension / body.pull_off[worst.contact]};
  }
  std::vector<double> times;
  const int samples = static_cast<int>(std::ceil(choice.strain / choice.sample));
  for (int k = 0; k <= samples; ++k) times.push_back(choice.strain * k / samples);
  double turned = 0;
  for (int k = 0; k < choice.orbits; ++k) {
    const Quaternion start = random_orientation(choice.seed, static_cast<std::uint32_t>(k));
    result.orbits.push_back(follow(
        body, start, times, [&](double) { return gradient; }, choice.tolerance));
    const Orbit& orbit = result.orbits.back();
    result.mean_peak_tension += orbit.peak.tension / choice.orbits;
    result.mean_tension += orbit.mean_max_tension / choice.orbits;
    turned += orbit.turned;
    if (orbit.peak.use > result.orbits[result.worst_orbit].peak.use) result.worst_orbit = static_cast<std::size_t>(k);
  }
  if (turned > 0) result.mean_tumbling_time = 2 * std::numbers::pi * choice.orbits * choice.strain / turned;
  return result;
}

}  // namespace crumble
