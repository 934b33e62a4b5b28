// Surface forces for an integrator of two rates: stiff pairs in every short step, the others once in a long one.
#pragma once

#include "dryer/model.hpp"
#include "dryer/surface_block.hpp"
#include "dryer/surface_pairs.hpp"

namespace crumble::dryer {

// Gap within which a pair of radius a is stiff in the droplet that has shrunk to R, m; solids: volume of all particles
// over 4 pi/3, m^3. 0 without surface forces.
double stiff_gap(const DryingModel& model, double a, double soft, double solids, double R);

class SurfaceLoads {
 public:
  // A pair is soft where |d^2U/dh^2| < soft, N/m; margin: by how much a gap may close within a long step, m.
  SurfaceLoads(const DryingModel& model, const BondLaws& contacts, const Particles& particles, double soft,
               double margin);

  // At the beginning of a long step: salt, pairs, and the forces of the soft ones, which stand until the next.
  void begin(const Frame& frame, double R);
  const std::vector<Pair>& stiff_pairs() const { return stiff_; }
  const Quad& soft_force(std::size_t particle) const { return soft_force_[particle]; }
  // The largest sum over the stiff pairs of one particle of what the double layers resist, at the nearest that they may
  // come within the long step, N/m.
  double stiffness_of_repulsion(const Frame& frame) const;

  // The stiff ones, of particles that stand at these places; places: how many there are; contacts: sorted.
  void gather(const std::vector<std::int32_t>& place, std::size_t places, const std::vector<Contact>& contacts);
  void set_bonded(const Pair& pair, bool bonded);
  // Forces of the stiff pairs on each place.
  void evaluate(const std::vector<Position>& position);
  const Quad& force(std::size_t place) const { return force_[place]; }

  double ionic_strength() const { return pairs_.laws().electrolyte().ionic_strength; }

 private:
  const Particles& particles_;
  SurfacePairs pairs_;
  double soft_, margin_;
  double stiff_gap_ = 0, stiff_gap_at_ = -1;  // m, mol/m^3
  std::vector<Pair> stiff_;
  SurfaceBlock stiff_block_, soft_block_;
  std::vector<Position> position_;
  std::vector<Quad, Eigen::aligned_allocator<Quad>> soft_force_, force_;
};

}  // namespace crumble::dryer
