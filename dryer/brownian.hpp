// The integrator for particles that diffuse: no inertia, thermal noise, contacts in short steps.
#pragma once

#include <optional>

#include "dryer/bond_block.hpp"
#include "dryer/brownian_path.hpp"
#include "dryer/integrator.hpp"
#include "dryer/surface_loads.hpp"
#include "dryer/work.hpp"

namespace crumble::dryer {

struct BrownianControl {
  double contact_step = 0.15;  // the short step, in the time a = zeta/k_n in which a contact relaxes
  int depth = 6;               // 2^depth short steps make one long step
};

// A part of the drying in which the contacts are equally soft.
struct BrownianStage {
  DryingModel model;  // with its softened contacts
  int depth;
  double most_bonds;  // per particle; with more the next stage begins
};

// dx = F/zeta dt + sqrt(2 D) dW and the same for rotations, D = kT/zeta (Eqs. 1, 4, 5 without inertia).
//
// Two rates. Particles that are bonded, or so near another that they may touch within the long step, take short steps
// that resolve the contact; all others take one long step. Both follow the particle's one Brownian path. The scheme is
// that of Leimkuhler & Matthews 2013, loads evaluated half of the noise ahead,
//
//   y' = y + dt F(y + dW/2)/zeta + dW,   contacts live at x = y + dW/2,
//
// whose x have the exact Boltzmann distribution in a harmonic well, for any stable step.
// A particle left dry has no noise (model.dry).
//
// Surface forces: pairs that are stiff against the long step join the short ones; those of the others stand over a long
// step, which is then explicit Euler for them: its variance in a harmonic well is off by less than soft_share/2.
class Brownian : public Integrator {
 public:
  static constexpr std::string_view summary =
      "Brownian motion without inertia: short steps for particles near or bonded to others, long ones for the rest";

  Brownian(const DryingModel& model, Agglomerate& state, std::uint64_t seed, const BrownianControl& control);

  // One long step. Throws std::domain_error naming the particle if the state is not finite.
  void step(double latest_time) override;

  void fields(SavedFields& f) override;

  // The fixed long steps of each stage. Short steps are for particles that have come to rest at the front, that a
  // neighbour is near, or that bonds hold together.
  static Work expected_work(const DryingModel& model, const std::vector<double>& radius,
                            const std::vector<BrownianStage>& stages, double contact_step, const StepTimes& times);

  // contact_step times zeta/k of the smallest pair, s: k the stiffest of its contact and its surface forces, at the
  // ionic strengths from the start to the solubility.
  static double short_step(const DryingModel& model, double a, double contact_step);
  double short_step() const { return dt_; }
  double long_step() const { return dt_ * static_cast<double>(substeps_); }
  // Of the liquid, where the scene has surface forces, mol/m^3.
  std::optional<double> ionic_strength() const override;

 private:
  struct Scales {
    double radius, short_step, margin;  // smallest radius, m; s; how near another must be to be met in a long step, m
  };
  static Scales scales(const DryingModel& model, const Agglomerate& state, const BrownianControl& control);
  Brownian(const DryingModel& model, Agglomerate& state, std::uint64_t seed, const BrownianControl& control,
           const Scales& scales);

  // Particles that take short steps; index: place in the block.
  struct Fast {
    std::vector<SixVector> drag;   // dt/zeta, dt/zeta_r
    std::vector<SixVector> noise;  // half of the noise of a short step per unit normal number, m and rad
    std::vector<SixVector> ahead;  // half of the noise and dt F/zeta, m and rad
    std::vector<double> radius;
    std::vector<float> radius_in_single;
    std::vector<float> pull;  // of the surface, over the distance from the centre, N/m
  };
  void classify();
  void gather();
  void fast_step(int step);
  double early(std::int32_t i, std::int32_t j) const;
  void add_bond(const Contact& bond, std::int32_t i, std::int32_t j);
  void predict(int step);
  void touch();
  void push();
  void surface();
  void advance_slow();
  void put_back();
  bool is_dry(std::int32_t particle) const;
  void check_finite() const;

  BrownianControl control_;
  BrownianPath path_;
  double dt_, margin_;
  int substeps_;
  double R_ = 0;
  std::vector<double> drag_, turning_drag_;
  std::vector<Vector6> ahead_;       // per particle: from the contacts' position x to the next y
  std::vector<std::int32_t> place_;  // of a particle in the block, or -1
  std::vector<char> near_;
  std::vector<std::uint32_t> fast_, slow_;
  std::size_t noisy_ = 0;  // as many of fast_ feel noise: the first
  Fast block_;
  std::vector<Pair> open_places_;
  MotionBlock motion_;
  BondBlock bonds_;
  std::vector<float> noise_, slow_noise_;
  std::optional<SurfaceLoads> surface_forces_;
};

}  // namespace crumble::dryer
