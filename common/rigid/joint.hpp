// A contact of a rigid agglomerate as an elastic joint of six degrees of freedom.
#pragma once

#include "common/agglomerate/agglomerate.hpp"
#include "common/contact/material.hpp"

namespace crumble {

enum class NormalStiffness { tangent, secant };

struct JointChoice {
  NormalStiffness normal = NormalStiffness::tangent;
  double twisting_factor = 1;  // of k_t; 0: free to twist
  double bending_factor = 1;   // of k_r; 0: free to bend
};

// Stiffness of the joint between spheres i and j, i < j. Only ratios decide how loads are shared.
struct Joint {
  int i = 0, j = 0;
  double normal = 0, sliding = 0;    // k_n, k_s, N/m
  double twisting = 0, bending = 0;  // k_t, k_r, N m/rad
};

// k_n from JKR at rest, the tangent (9/5) a F_po/b0^2 of Eq. 10 or the secant F_po/(h_po - h_eq) from rest to pull-off;
// k_s, k_t, k_r from Eqs. 13, 16, 20 (paper). Radii in m; for unequal spheres a is pair_radius (material.hpp).
Joint make_joint(const JointChoice& choice, const Material& material, int i, int j, double radius_i, double radius_j);

}  // namespace crumble
