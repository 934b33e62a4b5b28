// Surface forces of many pairs at once, in single precision.
#pragma once

#include <cstdint>
#include <vector>

#include "common/surface_forces/pair_forces.hpp"
#include "dryer/six_vector.hpp"

namespace crumble::dryer {

// The law of PairForces, which is its reference (SurfacePairs::add_forces): forces of a pair are good to 2e-4 of its
// pull-off force (test).
class SurfaceBlock {
 public:
  // Of all pairs that follow; what was there is gone.
  void begin(const SurfaceForceLaws& laws);
  // i, j: places of the positions.
  void add(std::int32_t i, std::int32_t j, const PairForces& forces, double a_i, double a_j, bool bonded);
  std::size_t size() const { return count_; }
  void set_bonded(std::size_t pair, bool bonded) { open_[pair] = bonded ? 0 : 1; }

  // Adds the force on each place, N.
  void add_forces(const Position* position, Quad* force) const;

 private:
  Lane tension(std::size_t first, const Lane& squared, const Lane& inverse) const;

  std::size_t count_ = 0;
  float kappa_ = 0, range_ = 0, hamaker_ = 0, retardation_ = 0;
  std::vector<std::int32_t> i_, j_;
  // A number a pair: a_i + a_j, 2 a_i a_j, h_j, h_po, 1/(length of JKR), F_po, strength of the double layers; 1 if
  // open.
  AlignedVector<float> sum_, product_, joined_, lost_, inverse_length_, pull_off_, strength_, open_;
};

}  // namespace crumble::dryer
