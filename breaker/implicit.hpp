// The default integrator: implicit, adaptive, in a frame that turns with the agglomerate.
#pragma once

#include <string_view>

#include "breaker/body_hydrodynamics.hpp"
#include "breaker/implicit_step.hpp"
#include "breaker/integrator.hpp"

namespace crumble::breaker {

// What one `tolerance` controls, a being the mean radius and l = h_po - h_eq the range of a bond:
//   local error of a step      gap of a bond  tolerance l,  anything else  0.1 tolerance a
//   largest motion in a step   4 tolerance a
//   matrices of the far field  renewed after a motion of 0.1 tolerance a, lubrication after 0.02 tolerance a;
//                              in float32 where ten times its error is less than that motion
//   a contact that is made     located within an overlap of 0.01 tolerance a
//   a contact that is lost     within a strain of 0.1 tolerance
// All errors fall in proportion to it.
class Implicit : public Integrator {
 public:
  static constexpr std::string_view summary =
      "implicit and adaptive in the frame of the turning body: steps as long as the motion is smooth";

  Implicit(const BreakupModel& model, const Protocol& protocol, const std::vector<double>& radius, Frame frame,
           double tolerance);

  bool step(double latest_time) override;
  Frame laboratory() const override;
  // Contacts that yield, are made and are lost end steps: 10 to 60 per contact, the least and the most of
  // pipeline/verify/ramp.md, from a chain of three to granules of 115, soft and stiff, weak and strong, at the default
  // tolerance.
  ExpectedSteps expected_steps(double rigid_strength) const override;

  const BodyHydrodynamics& hydrodynamics() const { return hydrodynamics_; }
  const Quaternion& rotation() const { return rotation_; }

  void fields(SavedFields& f) override;

 private:
  double tolerance_;
  BodyHydrodynamics hydrodynamics_;
  ImplicitStep solver_;
  Quaternion rotation_ = Quaternion::Identity();  // body -> laboratory
  double next_dt_ = 0, turn_step_ = 0, last_dt_ = 0, second_last_dt_ = 0;
  int history_ = 0;        // steps since the last making or loss of a contact, up to 2
  bool deformed_ = false;  // a contact was at a limit, or the far field renewed: no longer rigid
  Eigen::VectorXd rate_, last_rate_, increment_, predicted_;
  std::vector<Vector3> far_reference_, near_reference_;

  struct Attempt {
    bool accepted, changed;
    double retry;  // s
  };
  Attempt attempt(double dt, double time);
  double event_step() const;
  void predict(double dt);
  double local_error() const;
  double largest_motion() const;
  void renew_hydrodynamics();
};

}  // namespace crumble::breaker
