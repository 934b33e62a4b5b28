// A smaller droplet that stands for one of too many particles.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "common/agglomerate/morphology.hpp"
#include "common/io/machine.hpp"
#include "common/io/parameters.hpp"
#include "common/io/report.hpp"
#include "dryer/scene.hpp"

namespace crumble::dryer {

// What the answer to --fit-to asks for: so many particles, or as many as dry in this time on one core.
struct FitTo {
  std::optional<double> number, seconds;
};
// "2000", "90 s", "30 min", "1 h", "2 days". Throws InputError on anything else.
FitTo fit_to(const std::string& text);

// The scene of the droplet that holds `number` particles instead, as TOML with a comment on what it keeps and loses.
// Particles, bonds, liquid and solids are the same: so are capillary force over pull-off force and bond over kT. Of
// size and speed,  R0' = s R0,  s^3 = N'/N,  and
//   with Brownian motion     tau' = s^2 tau: Pe = R0^2/(D tau) is kept, the front is 1/s times as fast
//   without (Pe infinite)    tau' = s tau: the front's speed over that of the capillary force is kept
std::string stand_in(const Scene& scene, double number);

// For FitTo, with the largest number that its expected time allows. Throws InputError if the droplet has no more
// particles than that, or if the time is too short for any.
std::string stand_in(const Scene& scene, const FitTo& wanted, const Machine& machine);

// What is known of the granule of the real droplet, as lowest and highest value, from granules of other numbers.
struct RealGranule {
  double number = 0;
  std::array<double, 2> d_c{}, porosity{}, coordination{};  // d_c: m
  std::string known;                                        // from what
};
RealGranule real_granule(const DryingScene& scene, const Morphology& morphology);

// Both do nothing where the droplet stands for none but itself.
std::string real_granule_text(const DryingScene& scene, const Morphology& morphology);
void report_real_granule(Report& report, const DryingScene& scene, const Morphology& morphology);

}  // namespace crumble::dryer
