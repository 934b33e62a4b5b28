#include "breaker/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace crumble {

Integrator::Integrator(const BreakupModel& model, const Protocol& protocol, const std::vector<double>& radius,
                       Frame frame)
    : model_(model),
      protocol_(protocol),
      radius_(radius),
      length_(mean_radius(Spheres{{}, radius})),
      frame_(std::move(frame)),
      network_(model.contact, model.material, radius_, frame_) {}

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

Integrator::Memory Integrator::memory() const {
  const IntegratorStatistics& s = statistics_;
  return {{s.largest_overlap}, {s.steps, s.rejected, s.newton_iterations, s.factorisations, s.rigid_steps}};
}

void Integrator::recall(const Memory& memory) {
  const auto& c = memory.counts;
  statistics_ = {c.at(0), c.at(1), c.at(2), c.at(3), c.at(4), memory.numbers.at(0)};
}

}  // namespace crumble
