// When a rigid granule, carried along many histories of the velocity gradient, is first loaded beyond its strength.
#pragma once

#include <cstdint>

#include "common/flow/tracks.hpp"
#include "rigidstress/history.hpp"

namespace crumble::rigidstress {

// Brittle breakup without memory: the granule breaks at the first instant at which a contact bears its pull-off force
// (Babler, Biferale & Lanotte 2012, Phys. Rev. E 85, 025301). Everything scales with the viscosity: one path through
// orientations serves every ratio of the flow's stress to the granule's strength.
struct FirstExits {
  std::vector<double> level;     // sigma_rms/sigma_cr, rising: mu sqrt(<2 E:E>) over the critical stress in the worst
                                 // orientation in planar elongation or shear
  double rms_rate = 0;           // sqrt(<2 E:E>) over all tracks and their time, 1/s
  std::vector<double> duration;  // of each track, s
  std::vector<double> exit;      // tracks x levels: since the start of the track, s; infinite: it holds to the end

  double at(std::size_t track, std::size_t k) const { return exit[track * level.size() + k]; }
};

// 0.05 to 5, twelve a decade.
std::vector<double> usual_levels();

// Track k starts from even_orientations(seed, tracks)[k]. worst_use: use of pull-off in the worst orientation at a flow
// stress of 1 Pa, > 0. tolerance: of the orientation in one step. Any number of threads gives the same bits.
FirstExits first_exits(const LoadedBody& body, const Tracks& tracks, double worst_use, std::uint64_t seed,
                       double tolerance, std::vector<double> levels = usual_levels());

// What a rate is made from: by level and by interval of time since the start (geometric in 1/rms_rate), how many tracks
// saw their first exit, and how long all tracks together were at risk. Those loaded beyond their strength at the very
// start are counted apart: they say where a granule was put, not how often it breaks.
struct ExitCounts {
  std::vector<double> time;         // edges, s; one more than intervals
  std::vector<std::int64_t> born;   // of each level
  std::vector<std::int64_t> exits;  // levels x intervals
  std::vector<double> exposure;     // levels x intervals, s
};
ExitCounts count_exits(const FirstExits& found);

}  // namespace crumble::rigidstress
