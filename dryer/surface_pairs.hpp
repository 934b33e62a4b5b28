// Pairs of particles in the liquid whose surfaces feel each other, and the salt between them.
#pragma once

#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/agglomerate/open_pairs.hpp"
#include "common/surface_forces/pair_forces.hpp"
#include "dryer/droplet.hpp"

namespace crumble::dryer {

// Ionic strength of the liquid of volume V that was V0 at the start: concentrated(), in steps of 0.2 % so that the laws
// need not be found anew in every step. A function of the volume alone, so a restart sees the same.
double stepped_ionic_strength(const SurfaceForces& forces, double volume_before, double volume);

class SurfacePairs {
 public:
  // margin: pairs that come within range by it are listed, m. contacts and particles stay where they are.
  SurfacePairs(const SurfaceForces& forces, const Droplet& droplet, const BondLaws& contacts,
               const Particles& particles, double margin);

  // Salt and pairs as they are with the front at R.
  void update(const Frame& frame, double R);

  // Both centres in the liquid, gap below range + margin, bonded or not; sorted.
  const std::vector<Pair>& pairs() const { return pairs_; }
  const SurfaceForceLaws& laws() const { return laws_; }

  // Force on each particle is added, N. The slow obvious sum; contacts of the frame: sorted.
  void add_forces(const Frame& frame, std::vector<Vector3>& force) const;

 private:
  const Particles& particles_;
  SurfaceForceLaws laws_;
  double volume_at_start_, margin_;
  OpenPairs list_;
  std::vector<Pair> pairs_;
};

}  // namespace crumble::dryer
