// Brownian points in the drying droplet: what the continuum model is the mean of.
#pragma once

#include <cstdint>
#include <vector>

namespace crumble::dryer {

struct PointParticles {
  double peclet = 1;
  int number = 1000;
  int steps = 1000;  // to theta, equal in time
  std::uint64_t seed = 1;

  // rho = r/R of every point at theta. Uniform at theta = 0; then, with lengths in R0 and times in the lifetime,
  //   dx = sqrt(2/Pe) dW,  reflected at |x| = R = sqrt(1 - theta),
  // in the frame at rest: the surface moves, the points do not know of rho. A point beyond the surface at the end of a
  // step is put as far inside on the same radius (weak first order in the step: Bossy, Gobet & Talay 2004).
  std::vector<double> radii(double theta) const;
};

}  // namespace crumble::dryer
