// The default integrator: no inertia, implicit contacts, steps as long as the motion is smooth.
#pragma once

#include "dryer/implicit_step.hpp"
#include "dryer/integrator.hpp"

namespace crumble {

struct OverdampedControl {
  double largest_displacement = 0.01;  // of any particle in one step, in its radius
  double contact_precision = 1e-4;     // a contact is made when the overlap is within this, in the radius
};

// Steps through the drying with ImplicitStep. A step ends where the first new contact touches (its length is cut by the
// secant until the overlap is within contact_precision), so contacts are made one after another, in their order.
class Overdamped : public Integrator {
 public:
  Overdamped(const DryingModel& model, Agglomerate& state, const OverdampedControl& control);

  // One accepted step; the front does not pass the radius at `latest_time`. Throws std::runtime_error naming time, step
  // and the worst particle if no step length converges.
  void step(double latest_time) override;

  Memory memory() const override;
  void recall(const Memory& memory) override;

 private:
  struct Attempt {
    bool accepted = false;
    double retry = 0;  // length of the next attempt, s
  };
  Attempt attempt(double dt);
  double proposal(double latest_time) const;
  void predict(double dt);
  double touch_fraction() const;
  double largest_displacement() const;
  void accept(double dt);
  void refresh();

  OverdampedControl control_;
  ImplicitStep implicit_;
  bool network_changed_ = true;
  double next_dt_ = 0;         // proposal of the step control, s
  std::vector<Vector6> rate_;  // velocities of the last step, per particle
};

}  // namespace crumble
