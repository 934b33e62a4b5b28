// The forces between surfaces, of any pair of a set of particles.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "common/contact/bond_laws.hpp"
#include "common/surface_forces/double_layer.hpp"
#include "common/surface_forces/joined_attraction.hpp"
#include "common/surface_forces/surface_forces.hpp"

namespace crumble {

// DLVO (Derjaguin & Landau 1941; Verwey & Overbeek 1948): attraction and repulsion add. Both act between open pairs;
// between bonded ones the contact law is the attraction and the double layers go on to repel. Zero beyond `range`.
struct PairForces {
  const JoinedAttraction& attraction;
  DoubleLayer repulsion;
  double range;  // m

  // dU/dh, N, positive: attraction.
  double open_tension(double gap) const { return gap > range ? 0 : attraction.tension(gap) + repulsion.tension(gap); }
  double bonded_tension(double gap) const { return gap > range ? 0 : repulsion.tension(gap); }
  // J, zero from `range` on.
  double open_energy(double gap) const {
    return gap > range
               ? 0
               : attraction.energy(gap) + repulsion.energy(gap) - attraction.energy(range) - repulsion.energy(range);
  }
  double bonded_energy(double gap) const { return gap > range ? 0 : repulsion.energy(gap) - repulsion.energy(range); }
  // Largest tension that the pair bears in this liquid, where the attraction begins to fall: F_po + dV_R/dh at h_j, N.
  double pull_off_force() const {
    return attraction.contact().pull_off_force() + repulsion.tension(attraction.joined_gap());
  }
};

class SurfaceForceLaws {
 public:
  // radius: of all particles; they stay where they are. contacts: their bond laws.
  SurfaceForceLaws(const SurfaceForces& forces, const BondLaws& contacts, const std::vector<double>& radius);

  // The salt is concentrated: potentials, Debye length and range follow. mol/m^3.
  void set_ionic_strength(double ionic_strength);

  PairForces operator()(std::int32_t i, std::int32_t j) const;
  double range() const { return range_; }  // m
  double kappa() const { return electrolyte_.inverse_debye_length(); }
  const Electrolyte& electrolyte() const { return electrolyte_; }
  // Of an open pair of the largest particles: the largest |d^2U/dh^2|, N/m, and the gap beyond which it stays below a
  // bound, m.
  double largest_stiffness() const;
  double gap_of_stiffness(double bound) const;
  const SurfaceForces& forces() const { return forces_; }

 private:
  const JoinedAttraction& attraction(std::int32_t i, std::int32_t j) const;
  double slope(double gap) const;
  void find_range();

  const SurfaceForces forces_;
  const BondLaws& contacts_;
  const std::vector<double>& radius_;
  std::int32_t largest_;
  bool equal_;
  Electrolyte electrolyte_;
  std::vector<double> effective_;  // Y of each particle; of equal ones, one
  double range_ = 0;
  JoinedAttraction shared_;
  mutable std::unordered_map<std::uint64_t, JoinedAttraction> pairs_;
};

// Y of a particle of radius a at the surface potential or charge of the scene.
double effective_potential(const SurfaceForces& forces, const Electrolyte& electrolyte, double a);
// Its potential, V.
double surface_potential(const SurfaceForces& forces, const Electrolyte& electrolyte, double a);

}  // namespace crumble
