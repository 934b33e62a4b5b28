#include "rigidstress/flows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/numerics/noise.hpp"

namespace crumble::rigidstress {

namespace {

constexpr int sets = 4;

// Where set number s of `count` values begins.
std::size_t set_begin(int s, std::size_t count) { return static_cast<std::size_t>(s) * count / sets; }

Quaternion random_orientation(std::uint64_t seed, std::uint32_t number) {
  const auto q = random_normals(seed, Purpose::orientation, number, 0);
  return Quaternion(q[0], q[1], q[2], q[3]).normalized();
}

// Super-Fibonacci spiral: sqrt 2, and the root of x^4 = x + 4.
Quaternion on_spiral(std::size_t k, std::size_t count) {
  const double s = static_cast<double>(k) + 0.5, share = s / static_cast<double>(count);
  const double alpha = 2 * std::numbers::pi * s / std::numbers::sqrt2,
               beta = 2 * std::numbers::pi * s / 1.533751168755204288118041;
  const double r = std::sqrt(share), R = std::sqrt(1 - share);
  return {R * std::cos(beta), r * std::sin(alpha), r * std::cos(alpha), R * std::sin(beta)};
}

}  // namespace

std::vector<Quaternion> even_orientations(std::uint64_t seed, int count) {
  std::vector<Quaternion> all;
  const auto number = static_cast<std::size_t>(count);
  const int parts = number < 4 * sets ? 1 : sets;
  for (int s = 0; s < parts; ++s) {
    const Quaternion turn = random_orientation(seed, static_cast<std::uint32_t>(s));
    const std::size_t begin = parts == 1 ? 0 : set_begin(s, number),
                      end = parts == 1 ? number : set_begin(s + 1, number);
    for (std::size_t k = begin; k < end; ++k) all.push_back(turn * on_spiral(k - begin, end - begin));
  }
  return all;
}

std::optional<double> error_of_mean(const std::vector<double>& values) {
  if (values.size() < 4 * sets) return {};
  double all = 0, squares = 0;
  for (int s = 0; s < sets; ++s) {
    const std::size_t begin = set_begin(s, values.size()), end = set_begin(s + 1, values.size());
    double mean = 0;
    for (std::size_t k = begin; k < end; ++k) mean += values[k] / static_cast<double>(end - begin);
    all += mean / sets;
    squares += mean * mean / sets;
  }
  if (!(all > 0)) return {};
  return std::sqrt(std::max(squares - all * all, 0.0) / (sets - 1)) / all;
}

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
  constexpr double at_rest = 1e-8;  // of the shear rate; above what the integrator's tolerance leaves
  double t = 0, step = 0.1, stretch = 2;
  while (t < longest) {
    if (unrest(turning, q, gradient) < at_rest) return true;
    turning.advance(q, t, t + stretch, step, [&](double) { return gradient; });
    t += stretch;
    stretch *= 1.2;
  }
  return unrest(turning, q, gradient) < at_rest;
}

struct Rest {
  Quaternion orientation = Quaternion::Identity();
  bool settled = false;
};

// Of the starts from `first` on, before `end`.
std::vector<Rest> settled_starts(const LoadedBody& body, const Eigen::Matrix3d& gradient, const StrainingChoice& choice,
                                 int first, int end) {
  const TurningBody turning = body.turning(1e-10);
  const std::vector<Quaternion> starts = even_orientations(choice.seed, choice.starts);
  std::vector<Rest> all;
  for (int k = first; k < end; ++k) {
    Rest rest{starts[static_cast<std::size_t>(k)]};
    rest.settled = settle(turning, gradient, choice.longest_strain, rest.orientation);
    all.push_back(rest);
  }
  return all;
}

void rest_fields(SavedFields& f, std::vector<Rest>& all) {
  f.size("starts", all);
  f.column("orientation", all, &Rest::orientation);
  f.column("settled", all, &Rest::settled);
}

bool same_loads(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  constexpr double resolution = 1e-3;  // an attractor approached slowly is known less well than its own rest
  return (a - b).cwiseAbs().maxCoeff() <= resolution * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
}

}  // namespace

StrainingResult straining(const LoadedBody& body, const Eigen::Matrix3d& gradient, const StrainingChoice& choice,
                          Keeping keeping) {
  StrainingResult result;
  if (body.pull_off.empty()) return result;
  const WorstContact worst = worst_contact(body.response.tension, body.pull_off, gradient);
  result.worst = {worst.contact, worst.tension, worst.tension / body.pull_off[worst.contact]};
  result.worst_orientation =
      Quaternion(worst_orientation(body.response.tension.row(worst.contact).transpose(), gradient));
  // Rounding leaves a drift of about 1e-14 where symmetry forbids any.
  result.is_turning = body.response.drift.bottomRows<3>().cwiseAbs().maxCoeff() > 1e-9;

  constexpr int together = 64;
  std::vector<Rest> rests;
  for (int first = 0; first < choice.starts; first += together) {
    const int end = std::min(first + together, choice.starts);
    const std::vector<Rest> some = keeping.value(
        static_cast<std::size_t>(first), [&] { return settled_starts(body, gradient, choice, first, end); },
        rest_fields);
    rests.insert(rests.end(), some.begin(), some.end());
  }
  std::vector<Eigen::VectorXd> loads;
  const double share = 1.0 / choice.starts;
  int settled = 0;
  for (const auto& [q, is_settled] : rests) {
    if (!is_settled) {
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

void Orbit::fields(SavedFields& f) {
  f("time", time);
  f("orientation", orientation);
  f("max_tension", max_tension);
  f("peak.contact", peak.contact);
  f("peak.tension", peak.tension);
  f("peak.use", peak.use);
  f("peak_at", peak_at);
  f("mean_max_tension", mean_max_tension);
}

Orbit follow(const LoadedBody& body, const Quaternion& start, const std::vector<double>& times,
             const std::function<Eigen::Matrix3d(double)>& gradient_at, double tolerance) {
  const TurningBody turning = body.turning(tolerance);
  Orbit orbit;
  orbit.time = times;
  Quaternion q = start;
  double step = times.size() > 1 ? times[1] - times[0] : 0;
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
    if (k > 0)
      orbit.mean_max_tension += 0.5 * (times[k] - times[k - 1]) * (orbit.max_tension[k] + orbit.max_tension[k - 1]);
  }
  const double duration = times.back() - times.front();
  orbit.mean_max_tension = duration > 0 ? orbit.mean_max_tension / duration : orbit.max_tension.front();
  return orbit;
}

namespace {

// The body axis about which rotation meets least resistance: the long one.
Vector3 long_axis(const Response& response) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(response.drag.bottomRightCorner<3, 3>()).eigenvectors().col(0);
}

// Mean time of a turn of a body axis about the vorticity of simple shear (along -z): from the first to the
// last passage of its azimuth through the gradient direction, forward or backward end, so that whole half turns count.
// Less than two passages: by the angle turned so far.
double tumbling_time(const Orbit& orbit, const Vector3& axis) {
  using std::numbers::pi;
  double angle = 0, before = 0, next = 0, first = 0, last = 0;
  int passages = 0;
  for (std::size_t k = 0; k < orbit.time.size(); ++k) {
    const Vector3 x = orbit.orientation[k] * axis;
    const double azimuth = -std::atan2(x.y(), x.x());
    const double old = angle;
    if (k == 0) {
      angle = azimuth;
      next = pi * std::ceil(angle / pi - 0.5) + pi / 2;
    } else {
      angle += std::remainder(azimuth - before, 2 * pi);
    }
    before = azimuth;
    if (k == 0 || angle < next) continue;
    const double part = angle > old ? (next - old) / (angle - old) : 1;
    last = orbit.time[k - 1] + part * (orbit.time[k] - orbit.time[k - 1]);
    if (passages++ == 0) first = last;
    next += pi;
  }
  if (passages > 1) return 2 * (last - first) / (passages - 1);
  const Vector3 x = orbit.orientation.front() * axis;
  const double turned = angle + std::atan2(x.y(), x.x());
  return turned > 0 ? 2 * pi * (orbit.time.back() - orbit.time.front()) / turned : 0;
}

}  // namespace

ShearResult shear(const LoadedBody& body, const ShearChoice& choice, Keeping keeping) {
  ShearResult result;
  const Eigen::Matrix3d gradient = unit_gradient(FlowKind::shear);
  if (!body.pull_off.empty()) {
    const WorstContact worst = worst_contact(body.response.tension, body.pull_off, gradient);
    result.supremum = {worst.contact, worst.tension, worst.tension / body.pull_off[worst.contact]};
  }
  std::vector<double> times;
  const int samples = static_cast<int>(std::ceil(choice.strain / choice.sample));
  for (int k = 0; k <= samples; ++k) times.push_back(choice.strain * k / samples);
  const Vector3 axis = long_axis(body.response);
  const auto count = static_cast<double>(choice.starts.size());
  std::vector<double> peaks;
  for (const Quaternion& start : choice.starts) {
    result.orbits.push_back(keeping.value(
        result.orbits.size(),
        [&] {
          return follow(
              body, start, times, [&](double) { return gradient; }, choice.tolerance);
        },
        [](SavedFields& f, Orbit& orbit) { orbit.fields(f); }));
    const Orbit& orbit = result.orbits.back();
    peaks.push_back(orbit.peak.tension);
    result.mean_peak_tension += orbit.peak.tension / count;
    result.mean_tension += orbit.mean_max_tension / count;
    result.mean_tumbling_time += tumbling_time(orbit, axis) / count;
    if (orbit.peak.use > result.orbits[result.worst_orbit].peak.use) result.worst_orbit = result.orbits.size() - 1;
  }
  result.mean_error = error_of_mean(peaks);
  return result;
}

}  // namespace crumble::rigidstress
