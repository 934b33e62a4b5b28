#include "rigidstress/first_exit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace crumble::rigidstress {

namespace {

// Tensions over pull-off forces, the contact that could bear most in any flow of a given strength first: N = a.e is at
// most |a||e|, so most contacts need not be looked at.
class Uses {
 public:
  explicit Uses(const LoadedBody& body) {
    const auto count = static_cast<Eigen::Index>(body.pull_off.size());
    std::vector<Eigen::Index> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    const auto bound = [&](Eigen::Index b) {
      return body.response.tension.row(b).norm() / body.pull_off[static_cast<std::size_t>(b)];
    };
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return bound(a) > bound(b); });
    for (const Eigen::Index b : order) {
      row_.push_back(body.response.tension.row(b).transpose() / body.pull_off[static_cast<std::size_t>(b)]);
      bound_.push_back(bound(b));
    }
  }

  double largest(const Vector5& strain) const {
    const double size = strain.norm();
    double use = 0;
    for (std::size_t b = 0; b < row_.size() && bound_[b] * size > use; ++b) use = std::max(use, row_[b].dot(strain));
    return use;
  }

 private:
  std::vector<Vector5> row_;
  std::vector<double> bound_;
};

// first: of each level, infinite before.
void follow_exits(const Uses& uses, const TurningBody& turning, Quaternion q, const GradientHistory& history,
                  const std::vector<double>& threshold, double* first) {
  const std::vector<double>& times = history.times();
  double step = times[1] - times[0];
  std::size_t open = threshold.size();  // the thresholds fall: those from here on are crossed
  for (std::size_t k = 0; k < times.size() && open > 0; ++k) {
    if (k > 0) turning.advance(q, times[k - 1], times[k], step, [&](double t) { return history(t); });
    const double use = uses.largest(TurningBody::strain_seen(q, history.at(k)));
    while (open > 0 && use >= threshold[open - 1]) first[--open] = times[k] - times.front();
  }
}

}  // namespace

std::vector<double> usual_levels() {
  std::vector<double> levels;
  for (int k = 0; k <= 24; ++k) levels.push_back(0.05 * std::pow(10, k / 12.0));
  return levels;
}

FirstExits first_exits(const LoadedBody& body, const Tracks& tracks, double worst_use, std::uint64_t seed,
                       double tolerance, std::vector<double> levels) {
  FirstExits found;
  found.level = std::move(levels);
  double squares = 0, duration = 0;
  for (std::size_t k = 0; k < tracks.size; ++k) {
    const GradientHistory history = tracks.read(k);
    found.duration.push_back(history.times().back() - history.times().front());
    duration += found.duration.back();
    squares += history.mean_square_rate() * found.duration.back();
  }
  found.rms_rate = std::sqrt(squares / duration);
  found.exit.assign(tracks.size * found.level.size(), std::numeric_limits<double>::infinity());
  // At level r the stress is scaled such that mu rms_rate = r sigma_cr = r/worst_use.
  std::vector<double> threshold;
  for (const double r : found.level) threshold.push_back(found.rms_rate * worst_use / r);

  const Uses uses(body);
  const TurningBody turning = body.turning(tolerance);
  const std::vector<Quaternion> starts = even_orientations(seed, static_cast<int>(tracks.size));
  constexpr std::size_t together = 64;  // held at once
  for (std::size_t first = 0; first < tracks.size; first += together) {
    std::vector<GradientHistory> some;
    for (std::size_t k = first; k < std::min(first + together, tracks.size); ++k) some.push_back(tracks.read(k));
    const auto count = static_cast<std::ptrdiff_t>(some.size());
#pragma omp parallel for schedule(dynamic)
    for (std::ptrdiff_t j = 0; j < count; ++j) {
      const std::size_t k = first + static_cast<std::size_t>(j);
      follow_exits(uses, turning, starts[k], some[static_cast<std::size_t>(j)], threshold,
                   &found.exit[k * found.level.size()]);
    }
  }
  return found;
}

ExitCounts count_exits(const FirstExits& found) {
  ExitCounts counts;
  const double longest = *std::max_element(found.duration.begin(), found.duration.end());
  counts.time.push_back(0);
  for (double t = 0.25 / found.rms_rate; t < longest; t *= 2) counts.time.push_back(t);
  counts.time.push_back(longest);
  const std::size_t intervals = counts.time.size() - 1, levels = found.level.size();
  counts.born.assign(levels, 0);
  counts.exits.assign(levels * intervals, 0);
  counts.exposure.assign(levels * intervals, 0);
  for (std::size_t track = 0; track < found.duration.size(); ++track)
    for (std::size_t k = 0; k < levels; ++k) {
      const double exit = found.at(track, k), end = std::min(exit, found.duration[track]);
      if (exit == 0) {
        ++counts.born[k];
        continue;
      }
      for (std::size_t i = 0; i < intervals && counts.time[i] < end; ++i) {
        counts.exposure[k * intervals + i] += std::min(end, counts.time[i + 1]) - counts.time[i];
        if (exit > counts.time[i] && exit <= counts.time[i + 1]) ++counts.exits[k * intervals + i];
      }
    }
  return counts;
}

}  // namespace crumble::rigidstress
