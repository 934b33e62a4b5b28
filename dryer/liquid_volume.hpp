// How much liquid is left between the particles of a droplet.
#pragma once

#include "common/agglomerate/agglomerate.hpp"

namespace crumble::dryer {

// Volume that two spheres share whose centres are d apart, m^3: none beyond R + a, the smaller within |R - a|, else
//   pi (R + a - d)^2 (d^2 + 2 d (R + a) - 3 (R - a)^2)/(12 d)
double shared_volume(double R, double a, double d);

// Droplet of radius R less what of the particles lies in it, m^3; at least 0 (bonded particles overlap a little).
double liquid_volume(const Particles& particles, const Frame& frame, double R);
// The same of a droplet that all particles lie in.
double liquid_volume(const Particles& particles, double R);

}  // namespace crumble::dryer
