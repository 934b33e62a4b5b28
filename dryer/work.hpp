// How much work a run is: its steps, their time, and when in the drying they fall due. Each integrator forecasts its
// own (expected_work of its class; radius: m, of each particle, descending); expected_cost.hpp makes a range of it.
#pragma once

#include <array>
#include <vector>

#include "dryer/model.hpp"

namespace crumble::dryer {

// CPU seconds of one thread for one particle in one step, from a sample of the scene's particles (cost_sample.hpp).
struct StepTimes {
  double packed = 0;     // touching and bonded, within the surface; with Brownian motion of a short step
  double loose = 0;      // as at the start; with Brownian motion of a long step
  double particles = 0;  // of the sample
};

struct Work {
  double steps = 0;
  double seconds = 0;                // CPU, of one thread
  std::array<double, 65> done = {};  // share of the work at even fractions 1 - R/R0 of the front's way

  // Share of the work that is done when the front has gone this share of the radius.
  double share(double fraction) const;

  // Fills `done` with the integral of a rate of work over the front's way, the rate at a fraction; returns the
  // integral.
  template <class Rate>
  double add_up(Rate rate) {
    const auto last = static_cast<double>(done.size() - 1);
    for (std::size_t k = 1; k < done.size(); ++k)
      done[k] = done[k - 1] + rate((static_cast<double>(k) - 0.5) / last) / last;
    const double whole = done.back();
    for (double& part : done) part /= whole;
    return whole;
  }
};

// Share of the droplet at the start that the solids are. radius: m, of each particle.
double solids_share(const Droplet& droplet, const std::vector<double>& radius);

// Share of the particles that have a neighbour within reach or a bond, where the solids take up `packing`: one minus
// the chance of none (Poisson) in the shell in which the pair would be near, and in what a bond holds.
double share_near(double packing, double a, double margin, double stickiness);

// Bonds that thermal motion does not break: half of the particles have met after t = 3 mu/(4 kT n) (Smoluchowski).
double share_clustered(const DryingModel& model, double number, double time);

}  // namespace crumble::dryer
