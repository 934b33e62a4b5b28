#include "breaker/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "breaker/alignment.hpp"
#include "breaker/body_hydrodynamics.hpp"
#include "breaker/explicit_euler.hpp"
#include "breaker/implicit.hpp"
#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/io/granule.hpp"
#include "common/io/progress.hpp"

namespace crumble::breaker {

void append_frame(FrameLog& frames, const BreakupRun& run, const BreakerScene& scene) {
  const NetworkState& n = run.observation().network;
  frames.append(run.laboratory(), {{"flow_stress", run.stress()},
                                   {"shear_rate", run.stress() / scene.model.viscosity},
                                   {"max_tension", n.max_tension},
                                   {"slipping_count", static_cast<double>(n.slipping)},
                                   {"rolling_count", static_cast<double>(n.rolling)}});
}

void append_sample(FrameLog& frames, const BreakupRun& run) {
  const Observation& l = run.observation();
  frames.sample(run.statistics().steps, run.time(),
                {{"flow_stress", "Pa", l.at.stress},
                 {"radius_of_gyration", "nm", l.radius_of_gyration},
                 {"semi_axis_largest", "nm", l.semi_axes[0]},
                 {"semi_axis_middle", "nm", l.semi_axes[1]},
                 {"semi_axis_smallest", "nm", l.semi_axes[2]},
                 {"contacts", "", static_cast<double>(l.contacts)},
                 {"largest_fragment", "", static_cast<double>(l.largest_fragment)},
                 {"max_tension", "N", l.network.max_tension},
                 {"slipping", "", static_cast<double>(l.network.slipping)},
                 {"twisting", "", static_cast<double>(l.network.twisting)},
                 {"rolling", "", static_cast<double>(l.network.rolling)}});
}

std::optional<double> relative_error(const Breakup& b, std::optional<double> companion) {
  if (!b.severed || !companion || std::isinf(*companion)) return std::nullopt;
  return std::abs(*companion / b.severed->measure - 1);
}

namespace {

std::string how_estimated(const BreakerScene& scene, const Breakup& b, std::optional<double> companion) {
  if (!b.severed) return "nothing broke";
  if (!companion) return "not estimated: error.estimate = false";
  if (std::isinf(*companion)) return "not estimated: the companion run did not break";
  return scene.is(IntegratorKind::explicit_euler) ? "difference to the same run with half the step"
                                                  : "difference to the same run with doubled tolerance";
}

}  // namespace

namespace {

// At unit shear rate; of a history at the breakup, or at its end.
Eigen::Matrix3d unit_gradient_of(const BreakupRun& run, const BreakerScene& scene) {
  if (!scene.protocol.has_history()) return scene.model.gradient;
  const auto& severed = run.breakup().severed;
  const Eigen::Matrix3d gradient = scene.protocol.gradient(severed ? severed->time : run.time());
  const double rate = rate_of(gradient);
  return rate > 0 ? Eigen::Matrix3d(gradient / rate) : gradient;
}

}  // namespace

void write_rest(AgglomerateWriter& writer, const BreakupRun& run, const BreakerScene& scene, const Start& start,
                std::optional<double> companion) {
  const bool along_history = scene.protocol.has_history();
  if (const auto& severed = run.breakup().severed) {
    writer.put(along_history ? "/breakup/stress" : "/breakup/critical_stress", severed->stress);
    writer.put("/breakup/time", severed->time);
  }
  if (const auto error = relative_error(run.breakup(), companion))
    writer.put(along_history ? "/errors/breakup_time" : "/errors/critical_stress", *error,
               how_estimated(scene, run.breakup(), companion));
  writer.put("/closing/residual_rms", start.self_stress.rms);
  writer.put("/closing/residual_max", start.self_stress.max);
  writer.put("/closing/lost_contacts", static_cast<double>(start.lost));
  writer.put("/closing/scale", start.scale);
  writer.put_attribute("/flow@type", scene.flow_name());
  std::vector<double> gradient;
  const Eigen::Matrix3d unit = unit_gradient_of(run, scene);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) gradient.push_back(unit(r, c));
  writer.put<double>("/flow/gradient", gradient, {3, 3});

  std::vector<double> time, stress;
  std::vector<std::int32_t> kind, pair;
  std::vector<std::int64_t> offset{0}, sizes;
  for (const Event& e : run.events()) {
    time.push_back(e.time);
    stress.push_back(e.stress);
    kind.push_back(static_cast<std::int32_t>(e.kind));
    pair.insert(pair.end(), {e.i, e.j});
    sizes.insert(sizes.end(), e.sizes.begin(), e.sizes.end());
    offset.push_back(static_cast<std::int64_t>(sizes.size()));
  }
  const std::uint64_t count = time.size();
  writer.put<double>("/events/time", time, {count});
  writer.put<double>("/events/stress", stress, {count});
  writer.put<std::int32_t>("/events/kind", kind, {count});
  writer.put<std::int32_t>("/events/pair", pair, {count, 2});
  writer.put<std::int64_t>("/events/fragment_offset", offset, {count + 1});
  writer.put<std::int64_t>("/events/fragment_sizes", sizes, {sizes.size()});
}

double change(double before, double initial) { return initial > 0 ? before / initial - 1 : 0; }

std::string breakage(const Breakup& b, const BreakerScene& scene) {
  if (!b.severed) return "none";
  const double stretch = std::abs(change(b.before.semi_axes[0], b.initial.semi_axes[0]));
  return stretch < scene.brittle_below ? "brittle" : "ductile";
}

namespace {

void fill_left_out(Report& report, const BreakerScene& scene, const BreakupRun& run) {
  report.left_out.push_back("Brownian motion: out of scope; a bond of 100 nm spheres is worth far more than kT");
  report.left_out.push_back("inertia: Stokes flow, velocities follow forces at once");
  report.left_out.push_back("attraction outside contact: JKR acts from first touch to pull-off only, as in the paper");
  const auto& s = run.statistics();
  if (scene.is(IntegratorKind::implicit))
    report.left_out.push_back(fmt::format(
        "deformation in the first {} of {} steps: hydrodynamic matrices of the rest shape, since no contact "
        "was at a limit and no particle had moved by {:g} a in the axes of the body",
        s.rigid_steps, s.steps, 0.1 * scene.tolerance));
}

}  // namespace

void fill_report(Report& report, const BreakerScene& scene, const Start& start, const BreakupRun& run,
                 std::optional<double> companion) {
  const Breakup& b = run.breakup();
  const IntegratorStatistics s = run.statistics();
  const bool along_history = scene.protocol.has_history();
  const auto maybe = [](const std::optional<double>& value) {
    return value ? Report::Value(*value) : Report::Value(nullptr);
  };
  const auto stress = [&](const std::string& name, const std::string& rate, const std::optional<Instant>& value) {
    report.result(name + "_pa", maybe(value ? std::optional(value->stress) : std::nullopt));
    report.result(rate + "_per_s", maybe(value ? std::optional(scene.liquid.shear_rate(value->stress)) : std::nullopt));
  };
  const auto moment = [&](const std::string& name, const std::optional<Instant>& value) {
    if (along_history) report.result(name + "_time_s", maybe(value ? std::optional(value->time) : std::nullopt));
  };
  report.steps = s.steps;
  // What a history does at breakup is no strength: it may have been weaker or stronger just before.
  if (along_history)
    stress("breakup_stress", "breakup_shear_rate", b.severed);
  else
    stress("critical_stress", "critical_shear_rate", b.severed);
  moment("breakup", b.severed);
  stress("fragment_lost_stress", "fragment_lost_shear_rate", b.lost);
  moment("fragment_lost", b.lost);
  stress("rigid_prediction", "rigid_prediction_shear_rate",
         start.rigid_strength > 0 ? std::optional(Instant{0, start.rigid_strength}) : std::nullopt);
  stress("first_rupture_stress", "first_rupture_shear_rate", b.first_rupture);
  moment("first_rupture", b.first_rupture);
  stress("first_limit_stress", "first_limit_shear_rate", b.first_limit);
  moment("first_limit", b.first_limit);
  if (along_history) {
    report.result("history_duration_s", scene.protocol.end());
    report.result("followed_to_s", run.time());
    report.result("rigid_first_exceeded_s", maybe(scene.protocol.time_of(start.rigid_strength) < scene.protocol.end()
                                                      ? std::optional(scene.protocol.time_of(start.rigid_strength))
                                                      : std::nullopt));
  }
  report.result("largest_stress_pa", along_history ? scene.protocol.largest_stress(run.time()) : run.stress());
  report.result("contacts_initial", b.contacts_initial);
  report.result("contacts_at_breakup", b.before.contacts);
  report.result("rg_change_relative", change(b.before.radius_of_gyration, b.initial.radius_of_gyration));
  report.result("largest_semi_axis_change_relative", change(b.before.semi_axes[0], b.initial.semi_axes[0]));
  report.result("smallest_semi_axis_change_relative", change(b.before.semi_axes[2], b.initial.semi_axes[2]));
  report.result("fragments", b.fragments);
  report.result("breakage", breakage(b, scene));
  report.result("strain", run.protocol().strain(run.time()) / scene.model.viscosity);
  report.result("hydrodynamics", name_of(scene.model.hydro.rung));
  report.result("tolerance",
                scene.is(IntegratorKind::explicit_euler) ? Report::Value(nullptr) : Report::Value(run.tolerance()));
  report.result("scaled_by", start.scale);
  report.result("closing.residual_rms_over_f_po", start.self_stress.rms_use);
  report.result("closing.residual_max_over_f_po", start.self_stress.max_use);
  report.result("closing.lost_contacts", static_cast<std::int64_t>(start.lost));
  report.result("closing.made_contacts", static_cast<std::int64_t>(start.made));
  report.result("steps_rejected", s.rejected);
  report.result("newton_iterations", s.newton_iterations);
  report.error(along_history ? "breakup_time_relative" : "critical_stress_relative", relative_error(b, companion),
               how_estimated(scene, b, companion));
  report.error("largest_overlap_over_a", s.largest_overlap, "deepest overlap of two particles at the end of any step");
  fill_left_out(report, scene, run);
}

std::string result_text(const BreakupRun& run, const BreakerScene& scene, std::optional<double> companion) {
  const Breakup& b = run.breakup();
  const auto rate = [&](double stress) { return fmt::format("{:.3g} 1/s", scene.liquid.shear_rate(stress)); };
  std::string text;
  if (b.severed && scene.protocol.has_history()) {
    const auto error = relative_error(b, companion);
    text += fmt::format("breaks at              {:.6g}{} s of {:.6g} s, at {:.1f} Pa, {}, {}\n", b.severed->time,
                        error ? fmt::format(" ± {:.2g}", *error * b.severed->time) : "", scene.protocol.end(),
                        b.severed->stress, rate(b.severed->stress), breakage(b, scene));
    text += fmt::format("fragment beyond reach  {:.6g} s\n", b.lost->time);
  } else if (b.severed) {
    const auto error = relative_error(b, companion);
    text += fmt::format("critical stress        {:.1f}{} Pa, {}{}\n", b.severed->stress,
                        error ? fmt::format(" ± {:.1f}", *error * b.severed->stress) : "",
                        rate(b.severed->stress) + ", ", breakage(b, scene));
    text += fmt::format("fragment beyond reach  {:.1f} Pa, {}\n", b.lost->stress, rate(b.lost->stress));
  } else {
    text += run.ending() + "\n";
  }
  const auto happened = [&](const char* what, const std::optional<Instant>& instant) {
    if (!instant) return;
    const std::string time = scene.protocol.has_history() ? fmt::format("{:.6g} s, ", instant->time) : "";
    text += fmt::format("{}   {}{:.1f} Pa, {}\n", what, time, instant->stress, rate(instant->stress));
  };
  happened("first contact yields", b.first_limit);
  happened("first contact breaks", b.first_rupture);
  text += fmt::format("contacts               {} at first, {} before breakup\n", b.contacts_initial, b.before.contacts);
  text += fmt::format("radius of gyration     {:+.1f} %\n",
                      100 * change(b.before.radius_of_gyration, b.initial.radius_of_gyration));
  text += fmt::format("semi-axes              {:+.1f} % largest, {:+.1f} % smallest\n",
                      100 * change(b.before.semi_axes[0], b.initial.semi_axes[0]),
                      100 * change(b.before.semi_axes[2], b.initial.semi_axes[2]));
  text += "fragments             ";
  for (const std::int64_t size : b.fragments) text += fmt::format(" {}", size);
  text += "\n";
  text += fmt::format("1/s: shear rate in this liquid of {:g} Pa s", scene.liquid.viscosity);
  text += scene.protocol.has_history()
              ? ", root of 2 E:E along the history\n"
              : fmt::format("; {}, as in: {}\n", name_of(scene.flow), device_of(name_of(scene.flow)));
  if (relative_error(b, companion)) text += "±: " + how_estimated(scene, b, companion) + "\n";
  return text;
}

GranuleStrength granule_strength(const BreakupRun& run, const BreakerScene& scene, const Scene& text,
                                 const Start& start, std::optional<double> companion) {
  const Breakup& b = run.breakup();
  const Particles& p = start.agglomerate.particles;
  return {b.severed ? std::optional(b.severed->stress) : std::nullopt,
          run.stress(),
          name_of(scene.flow) + ", flexible",
          relative_error(b, companion),
          how_estimated(scene, b, companion),
          scene.model.material.surface_energy,
          source_of(text, "material.surface_energy"),
          radial_extent(start.agglomerate.state.position, p.radius, p.mass).diameter()};
}

std::string_view integrator_summary(const BreakerScene& scene) {
  return scene.is(IntegratorKind::implicit) ? Implicit::summary : ExplicitEuler::summary;
}

namespace {

void describe_history(const BreakerScene& scene, double strength, std::vector<std::string>& lines) {
  const Protocol& p = scene.protocol;
  const double mu = scene.model.viscosity, largest = mu * p.history().largest_rate(), first = p.time_of(strength);
  lines.push_back(
      fmt::format("history: {:.4g} s in {} instants, {} corners at this tolerance; strain {:.3g}; flow stress "
                  "up to {:.4g} Pa, at {:.4g} s",
                  p.end(), p.history().times().size(), p.corners(scene.tolerance, 1e-3 * strength).size(),
                  p.strain(p.end()) / mu, largest, p.time_of(largest)));
  lines.push_back(first < p.end() ? fmt::format("from {:.4g} s on it may break as a rigid body", first)
                                  : "as a rigid body it would hold: it breaks only if it deforms");
}

}  // namespace

std::vector<std::string> describe(const BreakerScene& scene, const Start& start) {
  const Particles& particles = start.agglomerate.particles;
  const Frame& frame = start.agglomerate.state;
  const double a = mean_radius(particles);
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{} particles of {:g} nm, {} contacts{}", particles.size(), a * 1e9,
                              frame.contacts.size(),
                              start.scale != 1 ? fmt::format(", scaled by {:g}", start.scale) : ""));
  if (start.closed)
    lines.push_back(
        fmt::format("contacts closed: self-stress {:.2g} F_po rms, {:.2g} F_po at most; {} contacts could "
                    "not be kept, {} new ones touch",
                    start.self_stress.rms_use, start.self_stress.max_use, start.lost, start.made));
  if (scene.model.hydro.rung == Rung::fts_lubrication)
    lines.push_back(
        "warning: fts-lubrication acts on the collective motion of near pairs and adds up over neighbours; "
        "it overestimates the loads of an almost rigid cluster. It is here to reproduce Eq. 9.");
  if (scene.model.gradient.isZero()) return lines;
  lines.push_back(fmt::format("integrator: {}", integrator_summary(scene)));
  const double mu = scene.model.viscosity;
  const double stress = start.rigid_strength;
  lines.push_back(fmt::format("as a rigid body it would break at {:.4g} Pa{}", stress,
                              scene.protocol.has_history() ? ", in the orientation that loads it most" : ""));
  if (scene.protocol.has_history()) {
    describe_history(scene, stress, lines);
    return lines;
  }
  const double time = std::min(scene.protocol.time_of(stress), scene.protocol.end());
  const double available = std::isfinite(time) ? scene.protocol.strain(time) / mu : 0;
  BodyHydrodynamics hydrodynamics(particles.radius, mu, scene.model.hydro);
  hydrodynamics.renew_far_field(frame.position);
  const auto needed = alignment_strain(hydrodynamics.turning(), scene.model.gradient);
  lines.push_back(fmt::format("strain available up to there: {:.3g}; needed to turn into the flow: {}", available,
                              needed ? fmt::format("{:.3g}", *needed) : "not within 2000"));
  if (needed && available < *needed)
    lines.push_back("warning: it may break before it is aligned; a slower ramp gives it more strain");
  return lines;
}

}  // namespace crumble::breaker
