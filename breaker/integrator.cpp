#include "breaker/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace crumble::breaker {

Integrator::Integrator(const BreakupModel& model, const Protocol& protocol, const std::vector<double>& radius,
                       Frame frame)
    : model_(model),
      protocol_(protocol),
      radius_(radius),
      length_(mean_radius(Spheres{{}, radius})),
      frame_(std::move(frame)),
      network_(model.contact, model.material, radius_, frame_, model.surface_forces) {}

bool Integrator::move(const Eigen::VectorXd& q, double time) {
  for (std::size_t p = 0; p < frame_.position.size(); ++p) {
    const auto step = q.segment<6>(6 * static_cast<Eigen::Index>(p));
    frame_.position[p] += step.head<3>();
    const Vector3 turn = step.tail<3>() / length_;
    const double angle = turn.norm();
    if (angle > 0)
      frame_.orientation[p] = (Quaternion(Eigen::AngleAxisd(angle, turn / angle)) * frame_.orientation[p]).normalized();
  }
  frame_.time = time;
  ++frame_.step;
  ++statistics_.steps;
  const bool changed = network_.advance(q, length_, stress(time));
  for (const Contact& bond : frame_.contacts)
    statistics_.largest_overlap =
        std::max(statistics_.largest_overlap, -bond.gap / pair_radius(radius_[bond.i], radius_[bond.j]));
  return changed;
}

void IntegratorStatistics::operator+=(const IntegratorStatistics& other) {
  steps += other.steps;
  rejected += other.rejected;
  newton_iterations += other.newton_iterations;
  factorisations += other.factorisations;
  rigid_steps += other.rigid_steps;
  largest_overlap = std::max(largest_overlap, other.largest_overlap);
}

void IntegratorStatistics::fields(SavedFields& f) {
  f("steps", steps);
  f("rejected", rejected);
  f("newton_iterations", newton_iterations);
  f("factorisations", factorisations);
  f("rigid_steps", rigid_steps);
  f("largest_overlap", largest_overlap);
}

void Integrator::fields(SavedFields& f) {
  statistics_.fields(f);
  network_.fields(f);
}

}  // namespace crumble::breaker
