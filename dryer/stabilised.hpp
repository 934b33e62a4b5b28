// The default integrator without Brownian motion, and with it where bonds are too strong for it: no inertia, explicit
// stabilised steps.
#pragma once

#include <optional>

#include "common/numerics/neighbours.hpp"
#include "dryer/bond_block.hpp"
#include "dryer/chebyshev.hpp"
#include "dryer/displacement.hpp"
#include "dryer/integrator.hpp"
#include "dryer/relaxation_rate.hpp"
#include "dryer/surface_loads.hpp"
#include "dryer/thermal_loads.hpp"
#include "dryer/work.hpp"

namespace crumble::dryer {

struct StabilisedControl {
  double largest_displacement = usual_displacement;  // of a particle in one stabilised step, in its radius
  // With Brownian motion, of a free particle while its thermal load stands, root mean square, in the smallest radius.
  double brownian_displacement = 0.005;
  // How near pairs must be to be looked at within a step(), in the smallest radius.
  double near(bool noisy) const {
    return std::max({0.2, 3 * largest_displacement, noisy ? 20 * brownian_displacement : 0});
  }
};

// dx/dt = F/zeta and the same for rotations by the method of chebyshev.hpp: as many evaluations a step as the stiffest
// contact asks for, and no system of equations. Each evaluation is a short way of all particles, on which bonds are
// carried, made and lost as in Brownian drying. On all threads; the same bits on any number of them.
//
// A step() of the integrator is several stabilised steps with one list of particles and near pairs. Particles that
// neither the front nor a bond has reached are in it only as obstacles.
//
// With Brownian motion each particle has a load more, that of thermal_loads.hpp, and a stabilised step ends with its
// interval. Particles without bond or near neighbour, and away from the surface, go its whole way at once. What the
// liquid has left dry has no noise (model.dry).
//
// Surface forces are evaluated as the bonds are. With Brownian motion those of pairs that are too far apart to be stiff
// within a step() stand as long as that.
class Stabilised : public Integrator {
 public:
  static constexpr std::string_view summary =
      "explicit stabilised steps: as many evaluations as the stiffest contact asks for, no equations";

  Stabilised(const DryingModel& model, Agglomerate& state, const StabilisedControl& control, std::uint64_t seed = 0);

  // Throws std::domain_error naming the particle if the state is not finite.
  void step(double latest_time) override;

  // Surface forces of pairs that resist less stand over a step(), N/m; 0 without noise: all are evaluated each time.
  static double soft_stiffness(const DryingModel& model, double a, const StabilisedControl& control);

  void fields(SavedFields& f) override;
  std::optional<double> ionic_strength() const override;

  // Evaluations: stages of the Chebyshev method, summed over steps that the front makes each in the time of the largest
  // displacement. The fastest rate is some 12 k/zeta, k the stiffest spring of a bond, or that at which a strong
  // surface catches a particle. With Brownian motion there is a step in each interval of the thermal loads at least,
  // and only those take part that have met another or lie at the front.
  static Work expected_work(const DryingModel& model, const std::vector<double>& radius,
                            const StabilisedControl& control, const StepTimes& times);

 private:
  void choose(double R_end);
  bool is_dry(std::int32_t particle, double R) const;
  std::vector<char> who_moves(double R_end) const;
  void load_thermally();
  void advance_free(double passed);
  double thermal_way(double time) const;
  void gather();
  void put_back(double begin);
  void stabilised_step(double latest_time);
  double limit_of_rate();
  bool is_stable(double limit);
  double rate() const;
  double rate_of_a_bond() const;
  bool nearer(const Pair& places, float gap) const;
  void part(double time);
  void push(const Chebyshev::Stage& stage, double dt, double R);
  void push_some(std::size_t first, const Chebyshev::Stage& stage, double dt, double R);
  bool meet(std::vector<Pair>& pairs, double limit);
  void lose();
  template <class From>
  void measure(From from);
  double farthest();
  double time_of_travel(double radii) const;

  StabilisedControl control_;
  double near_;         // of control_, in the smallest radius
  double next_dt_ = 0;  // s
  std::optional<ThermalLoads> noise_;
  std::optional<SurfaceLoads> surface_forces_;
  double repulsion_rate_ = 0;       // of the stiff ones within the step(), 1/s
  std::vector<SixVector> thermal_;  // of the places; empty without noise
  std::vector<char> noisy_;         // whether the place has noise
  std::vector<std::size_t> free_;   // particles without place that noise moves
  std::vector<Vector3> free_way_;   // of each since the beginning of the step(), m
  std::vector<std::int32_t> chosen_, place_;
  Mobility mobility_;
  double known_rate_ = 0;  // bound for the bonds as they were when their stiffness was last remembered, 1/s
  std::vector<float> radius_;
  std::vector<Position> before_;
  MotionBlock motion_;  // its ways are the increments of the last evaluation
  BondBlock bonds_;
  std::vector<Pair> open_pairs_, closest_;  // places that may meet within the step, and until the next look
  std::vector<double> moves_;
  std::vector<char> closer_;
};

}  // namespace crumble::dryer
