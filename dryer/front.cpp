#include "dryer/front.hpp"

#include <algorithm>

namespace crumble::dryer {

DryCrust dry_crust(const Particles& particles, const Frame& frame, double R) {
  double covered = 0, reach = 0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double a = particles.radius[p], r = frame.position[p].norm();
    if (r <= R || r == 0) continue;
    const double share = a * a / (4 * r * r);
    covered += share;
    reach += share * (r + a);
  }
  return covered > 0 ? DryCrust{std::min(covered, 1.0), reach / covered} : DryCrust{};
}

double Front::radius(double time) const { return droplet_.radius(reduced(time)); }

double Front::time_at(double R) const {
  if (droplet_.curve) return time_of(droplet_.curve->time_at(R));
  return time_of(droplet_.time_at(R));
}

void Front::fields(SavedFields& f) {
  f("front_time", past_.time);
  f("front_reduced_time", past_.reduced);
  f("front_rate", past_.rate);
}

void Front::follow(const Agglomerate& state) {
  if (!may_slow_down()) return;
  const double now = state.state.time;
  // The last step aims at end(); round-off must not leave a remainder.
  const double passed = now >= end() ? droplet_.lifetime : reduced(now);
  const double R = droplet_.radius(passed);
  const DryCrust crust = dry_crust(state.particles, state.state, R);
  past_ = {now, passed, crust.covered > 0 ? crust_hindrance(relative_, crust.covered, R, crust.reach) : 1};
}

}  // namespace crumble::dryer
