// The product w = M q with the far-field mobility of far_field.hpp, summed over pairs without storing a matrix.
#pragma once

#include <vector>

#include "common/hydro/far_field.hpp"

namespace crumble {

// N^2 ordered pairs in float64, a register of receivers at a time, OpenMP over these: some nanoseconds a pair, and
// memory of order N. The summation order is fixed: results do not depend on the number of threads.
class FarFieldSum {
 public:
  explicit FarFieldSum(const Spheres& spheres);

  int size() const { return n_; }

  // Vectors of 11N entries in the order of MobilityMatrix: [5 strains or stresslets a sphere | 6 of motion or force].
  void apply(const double* q, double* w) const;

 private:
  int n_ = 0;
  std::vector<double> x_, y_, z_, radius2_;  // radii squared over 6
  std::vector<SelfMobility> self_;
};

}  // namespace crumble
