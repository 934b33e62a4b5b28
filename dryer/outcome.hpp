// What becomes of a droplet: the shape that is expected of a scene, and the one that was found.
#pragma once

#include <string>

#include "common/agglomerate/morphology.hpp"
#include "dryer/regime.hpp"

namespace crumble::dryer {

enum class Shape { dust, hollow, thick_crust, compact };
const char* name_of(Shape shape);

struct Expected {
  Shape shape;
  std::string why;
};

// Three numbers decide, in this order; the bounds are between granules of pipeline/verify/regime.csv (N = 115) and of
// `make -C pipeline map` (N = 85) that came out different:
//   front speed over capillary speed where the solids are packed > 1: dust (0.8: granules, 2.3: dust)
//   Pe < 20: compact (10: compact; 30: compact of 115, not quite of 85)
//   capillary over pull-off force > 0.45: compact, the shell collapses (0.19: hollow, 0.97: compact)
//   Pe < 60: a thick crust (30: thick, 100: hollow)
//   else hollow
Expected expected_shape(const DryingRegime& regime);

// Mean distance of the nearest tenth of the centres from the middle over that of the farthest tenth. Of a solid ball of
// many particles it is 0.1^(4/3)/(1 - 0.9^(4/3)) = 0.35, of a thin shell 1; unlike h_c/d_c it does not change with the
// number of particles: 0.59 to 0.64 from 30 to 100,000 particles without Brownian motion.
double cavity(const RadialExtent& extent, double mean_radius);

// cavity below 0.42: compact (measured 0.35 to 0.41); above 0.52: hollow (0.53 to 0.69); dust: more than a tenth as
// many pieces as particles.
Shape found_shape(const Morphology& morphology, double mean_radius);

// "expected hollow (Pe = 300: ...), found hollow: ..."
std::string outcome_text(const DryingScene& scene, const Morphology& morphology);
void report_outcome(Report& report, const DryingScene& scene, const Morphology& morphology);

}  // namespace crumble::dryer
