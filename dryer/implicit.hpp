// No inertia, implicit contacts, steps as long as the motion is smooth: a second opinion beside stabilised.hpp, and for
// any contact law.
#pragma once

#include <limits>

#include "dryer/displacement.hpp"
#include "dryer/implicit_step.hpp"
#include "dryer/integrator.hpp"
#include "dryer/work.hpp"

namespace crumble::dryer {

struct ImplicitControl {
  double largest_displacement = usual_displacement;  // of any particle in one step, in its radius
  double contact_precision = 1e-4;                   // overlap that no bond holds at the end of a step, in the radius
};

// Steps through the drying with ImplicitStep. Whatever overlaps at the end of a step by more than contact_precision is
// bonded within the step, its springs loaded from the touch on, and the step is solved again with the new bonds until
// nothing more overlaps. So contacts do not limit the steps, however many there are.
class Implicit : public Integrator {
 public:
  static constexpr std::string_view summary =
      "implicit steps: as long as the motion is smooth, each the solution of equations for all";

  Implicit(const DryingModel& model, Agglomerate& state, const ImplicitControl& control);

  // One accepted step; the front does not pass the radius at `latest_time`. Throws std::runtime_error naming time, step
  // and the worst particle if no step length converges.
  void step(double latest_time) override;

  void fields(SavedFields& f) override;

  // A step for each 0.8 of the largest displacement that the front advances, and 5.5 N^0.75 that contacts end: fitted
  // to runs. The time of a step grows like N^1.23.
  static Work expected_work(const DryingModel& model, const std::vector<double>& radius, const ImplicitControl& control,
                            const StepTimes& times);

 private:
  struct Attempt {
    bool accepted = false;
    double retry = 0;  // length of the next attempt, s
  };
  Attempt attempt(double dt);
  double proposal(double latest_time) const;
  void predict(double dt);
  double displacement();
  Vector3 moved(std::int32_t particle) const;
  Motion motion_of(std::int32_t particle) const {
    return {implicit_.translation(particle), implicit_.rotation(particle)};
  }
  void find_touches();
  void bond_touches();
  void take_back_bonds();
  void accept(double dt);
  void refresh();
  void require_advance(double dt, double left);

  ImplicitControl control_;
  ImplicitStep implicit_;
  bool network_changed_ = true;
  double mark_ = std::numeric_limits<double>::infinity();  // radius of the front when steps were counted last, m
  std::int64_t short_steps_ = 0;                           // since then, much shorter than the front allows
  double next_dt_ = 0;                                     // proposal of the step control, s
  struct Touch {
    Pair pair;
    double fraction;  // of the step
  };
  std::vector<Touch> touches_;
  std::vector<Pair> provisional_;  // bonds made in the step that is being tried
  std::vector<double> moves_;
  std::vector<Vector6> rate_;  // velocities of the last step, per particle
};

}  // namespace crumble::dryer
