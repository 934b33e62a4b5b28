#include "dryer/outcome.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace crumble::dryer {

namespace {

constexpr double compact_peclet = 20, hollow_peclet = 60, collapsing_force = 0.45;
constexpr double compact_cavity = 0.42, hollow_cavity = 0.52;

double mean_of(const std::vector<double>& radius) {
  return std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
}

}  // namespace

const char* name_of(Shape shape) {
  switch (shape) {
    case Shape::dust:
      return "dust";
    case Shape::hollow:
      return "hollow";
    case Shape::thick_crust:
      return "thick crust";
    default:
      return "compact";
  }
}

Expected expected_shape(const DryingRegime& r) {
  const double outrun = r.packed_front_speed / r.capillary_speed;
  if (outrun > 1)
    return {Shape::dust, fmt::format("the front is {:.2g} times as fast as the capillary force can pull and leaves the "
                                     "particles dry where they are",
                                     outrun)};
  if (r.peclet < compact_peclet)
    return {Shape::compact, fmt::format("Pe = {:.3g}: diffusion keeps the particles spread", r.peclet)};
  if (r.force_ratio > collapsing_force)
    return {Shape::compact, fmt::format("capillary force beats the bonds, {:.2g} of the pull-off force: the shell "
                                        "collapses",
                                        r.force_ratio)};
  if (r.peclet < hollow_peclet)
    return {Shape::thick_crust, fmt::format("Pe = {:.3g}: between diffusion and the front", r.peclet)};
  return {Shape::hollow,
          fmt::format("Pe = {}: the front sweeps the particles into a shell, and the bonds bear the "
                      "capillary force, {:.2g} of their pull-off force",
                      std::isinf(r.peclet) ? "infinity" : fmt::format("{:.3g}", r.peclet), r.force_ratio)};
}

double cavity(const RadialExtent& extent, double a) { return (extent.inner + a) / (extent.outer - a); }

Shape found_shape(const Morphology& m, double a) {
  if (10 * m.fragments > m.particles) return Shape::dust;
  const double c = cavity(m.extent, a);
  return c < compact_cavity ? Shape::compact : c > hollow_cavity ? Shape::hollow : Shape::thick_crust;
}

std::string outcome_text(const DryingScene& scene, const Morphology& m) {
  const Expected expected = expected_shape(drying_regime(scene));
  const double a = mean_of(scene.radius);
  const Shape found = found_shape(m, a);
  return fmt::format(
      "expected      {} ({})\nfound         {}{}: the nearest tenth of the particles {:.2f} times as far from "
      "the middle as the farthest\n",
      name_of(expected.shape), expected.why, name_of(found), found == expected.shape ? ", as expected" : "",
      cavity(m.extent, a));
}

void report_outcome(Report& report, const DryingScene& scene, const Morphology& m) {
  const Expected expected = expected_shape(drying_regime(scene));
  const double a = mean_of(scene.radius);
  report.result("outcome.expected", std::string(name_of(expected.shape)));
  report.result("outcome.why", expected.why);
  report.result("outcome.found", std::string(name_of(found_shape(m, a))));
  report.result("outcome.cavity", cavity(m.extent, a));
}

}  // namespace crumble::dryer
