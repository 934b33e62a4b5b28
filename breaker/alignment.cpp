#include "breaker/alignment.hpp"

#include <vector>

namespace crumble::breaker {

std::optional<double> alignment_strain(const Eigen::Matrix<double, 3, 5>& turning, const Eigen::Matrix3d& gradient,
                                       double angle, double longest) {
  const TurningBody body(turning, 1e-8);
  const double stretch = 0.5;
  std::vector<Quaternion> path{Quaternion::Identity()};
  double step = 0.1;
  for (double t = 0; t < longest; t += stretch) {
    Quaternion q = path.back();
    body.advance(q, t, t + stretch, step, [&](double) { return gradient; });
    path.push_back(q);
    // Settled: less than a thousandth of the angle in the last fifth of the way.
    const std::size_t before = path.size() - 1 - path.size() / 5;
    if (path.size() > 20 && q.angularDistance(path[before]) < 1e-3 * angle) break;
    if (t + stretch >= longest) return std::nullopt;
  }
  std::size_t last = 0;
  for (std::size_t k = 0; k < path.size(); ++k)
    if (path[k].angularDistance(path.back()) > angle) last = k + 1;
  return stretch * static_cast<double>(last);
}

}  // namespace crumble::breaker
