#include "rigidstress/result.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/agglomerate/morphology.hpp"
#include "common/io/granule.hpp"
#include "rigidstress/mobility_numbers.hpp"

namespace crumble::rigidstress {

namespace {

// Numbers are those of the body that breaks first; tensions in 6 pi mu gamma_dot a^2, a the mean radius of all.
struct Numbers {
  const Analysis& analysis;
  const BodyResult& body;
  Liquid liquid;
  double a, force;  // m; N at a flow stress of 1 Pa
  Numbers(const Analysis& all, const StressScene& scene)
      : analysis(all),
        body(all.weakest()),
        liquid(scene.liquid),
        a(mean_radius(all.prepared.particles)),
        force(6 * std::numbers::pi * a * a) {}

  // A critical stress with the shear rate that reaches it; use: of the pull-off force at 1 Pa, 0: it never breaks.
  void add_critical(Report& report, const std::string& group, const std::string& kind, double use) const {
    const auto value = [&](double x) { return use > 0 ? Report::Value(x) : Report::Value(nullptr); };
    report.result(group + ".critical_stress" + kind + "_pa", value(1 / use));
    report.result(group + ".critical_shear_rate" + kind + "_per_s", value(liquid.shear_rate(1 / use)));
  }
  Report::Value pair(const Peak& peak) const {
    if (peak.contact < 0) return nullptr;
    const Contact& c = contact(peak);
    return std::vector<std::int64_t>{c.i, c.j};
  }
  Report::Value distance_nm(const Peak& peak) const {
    if (peak.contact < 0) return nullptr;
    const Contact& c = contact(peak);
    const auto& x = analysis.prepared.position;
    return 1e9 * (0.5 * (x[c.i] + x[c.j]) - body.centre).norm();
  }

 private:
  const Contact& contact(const Peak& peak) const {
    return analysis.prepared.frame.contacts[body.body.contact[peak.contact]];
  }
};

// The attractor that most starts reach; without contacts or rest, nothing.
const Attractor* settled(const StrainingResult& r) { return r.attractors.empty() ? nullptr : &r.attractors.front(); }

void add_straining(Report& report, const std::string& name, const Numbers& n, const StrainingResult& r) {
  const auto add = [&](const std::string& key, Report::Value value) { report.result(name + "." + key, value); };
  const Attractor* rest = settled(r);
  const Peak peak = rest ? rest->peak : Peak{};
  add("n_max_settled", rest ? Report::Value(peak.tension / n.force) : Report::Value(nullptr));
  add("n_max_worst", r.worst.tension / n.force);
  n.add_critical(report, name, "_settled", peak.use);
  n.add_critical(report, name, "_worst", r.worst.use);
  add("contact", n.pair(peak));
  add("contact_distance_nm", n.distance_nm(peak));
  add("contact_worst", n.pair(r.worst));
  add("contact_worst_distance_nm", n.distance_nm(r.worst));
  std::vector<double> shares, tensions;
  for (const Attractor& attractor : r.attractors) {
    shares.push_back(attractor.share);
    tensions.push_back(attractor.peak.tension / n.force);
  }
  add("attractor_share", shares);
  add("attractor_n_max", tensions);
  add("n_max_mean_of_starts", r.mean_settled_tension / n.force);
  add("unsettled_share", r.unsettled);
  add("device_settled", std::string(device_of(name)));
  add("device_worst", std::string(device_of(name == "elongation" ? "turbulence" : name)));
}

void add_shear(Report& report, const Numbers& n, const ShearResult& r) {
  const Orbit& worst = r.orbits[r.worst_orbit];
  std::vector<double> peaks;
  double use = 0;
  for (const Orbit& orbit : r.orbits) {
    peaks.push_back(orbit.peak.tension / n.force);
    use += orbit.peak.use / static_cast<double>(r.orbits.size());
  }
  report.result("shear.n_max_orbit", r.mean_peak_tension / n.force);
  report.error("shear_n_max_orbit_relative", r.mean_error,
               r.mean_error ? "standard error of the mean over the orbits, from four sets of them"
                            : "not known: fewer than 16 orbits");
  report.result("shear.n_max_time_mean", r.mean_tension / n.force);
  report.result("shear.mean_tumbling_time", r.mean_tumbling_time);
  n.add_critical(report, "shear", "", use);
  report.result("shear.n_max_supremum", r.supremum.tension / n.force);
  n.add_critical(report, "shear", "_supremum", r.supremum.use);
  report.result("shear.n_max_of_each_orbit", peaks);
  report.result("shear.device", std::string(device_of("shear")));
  report.result("shear.contact", n.pair(worst.peak));
  report.result("shear.contact_distance_nm", n.distance_nm(worst.peak));
}

void add_history(Report& report, const Numbers& n, const HistoryResult& r, const StressScene& scene) {
  const Orbit& worst = r.orbits[r.worst_orbit];
  const double rate = scene.history->largest_rate(), mu = scene.liquid.viscosity;
  report.result("history.n_max_orbit", r.mean_peak_tension / (n.force * rate));
  report.result("history.n_max_worst_orbit", worst.peak.tension / (n.force * rate));
  report.result("history.n_max_worst_orbit_n", mu * worst.peak.tension);
  report.result("history.use_of_pull_off", mu * worst.peak.use);
  report.result("history.largest_stress_pa", mu * rate);
  n.add_critical(report, "history", "", worst.peak.use / rate);
  report.result("history.time_s", worst.time[worst.peak_at]);
  report.result("history.contact", n.pair(worst.peak));
}

void add_exits(Report& report, const FirstExits& found) {
  const ExitCounts counts = count_exits(found);
  report.result("tracks.count", static_cast<std::int64_t>(found.duration.size()));
  report.result("tracks.rms_rate_per_s", found.rms_rate);
  report.result("tracks.level", found.level);
  report.result("tracks.time_s", counts.time);
  report.result("tracks.born_above", counts.born);
  report.result("tracks.exits", counts.exits);
  report.result("tracks.exposure_s", counts.exposure);
}

void add_drag(Report& report, const Numbers& n) {
  const MobilityNumbers m = mobility_numbers(n.body.loaded.response.drag);
  const double unit = 6 * std::numbers::pi * n.a;
  const auto list = [](const Vector3& v, double u) { return std::vector<double>{v[0] / u, v[1] / u, v[2] / u}; };
  report.result("drag_over_6_pi_mu_a", list(m.drag, unit));
  report.result("rotation_over_6_pi_mu_a3", list(m.rotation, unit * n.a * n.a));
  report.result("hydrodynamic_radius_nm", 1e9 * m.hydrodynamic_radius);
  report.result("hydrodynamic_radius_over_a", m.hydrodynamic_radius / n.a);
}

void add_fragments(Report& report, const Numbers& n) {
  const auto& all = n.analysis.bodies;
  report.result("fragments", static_cast<std::int64_t>(all.size()));
  if (all.size() == 1) return;
  std::vector<std::int64_t> sizes;
  std::vector<double> worst;
  for (const BodyResult& b : all) {
    sizes.push_back(static_cast<std::int64_t>(b.body.particle.size()));
    worst.push_back(b.worst.tension / n.force);
  }
  report.result("fragment_sizes", sizes);
  report.result("fragment_n_max_worst", worst);
}

double largest_self_stress(const Prepared& p) { return p.largest_tension; }

}  // namespace

void fill_report(Report& report, const Analysis& a, const StressScene& scene) {
  const Numbers n(a, scene);
  const auto contacts = static_cast<std::int64_t>(a.prepared.frame.contacts.size());
  report.result("hydrodynamics", a.method);
  report.result("particles", static_cast<std::int64_t>(a.prepared.particles.size()));
  report.result("particle_radius_nm", 1e9 * n.a);
  report.result("contacts", contacts);
  report.result("coordination", coordination_number(a.prepared.particles.size(), static_cast<std::size_t>(contacts)));
  report.result("statically_determinate_contacts", std::int64_t{n.body.bridges});
  report.result("contacts_lost_in_closing", static_cast<std::int64_t>(a.prepared.lost.size()));
  report.result("scaled_by", a.prepared.scale);
  add_fragments(report, n);
  add_drag(report, n);
  if (n.body.elongation) add_straining(report, "elongation", n, *n.body.elongation);
  if (n.body.shear) add_shear(report, n, *n.body.shear);
  if (n.body.uniaxial) add_straining(report, "uniaxial", n, *n.body.uniaxial);
  if (n.body.biaxial) add_straining(report, "biaxial", n, *n.body.biaxial);
  if (n.body.history) add_history(report, n, *n.body.history, scene);
  if (n.body.exits) add_exits(report, *n.body.exits);

  const bool restored = a.restored;
  report.error("n_max_relative", a.error, a.how);
  const Response& r = n.body.loaded.response;
  const auto known = [&](double value) { return restored ? std::optional<double>() : value; };
  report.error("load_balance_relative", known(r.imbalance),
               restored ? "not computed: the response was read from the file"
                        : "net force and torque of the fluid on the free body over the sum of their parts");
  report.error("particle_balance_relative", known(r.residual),
               restored ? "not computed: the response was read from the file"
                        : "largest unbalanced load of a particle over the largest load on one");
  report.error("self_stress_n", a.prepared.residual_max,
               "largest force that closing the contacts left, not part of the tensions reported");
  report.left_out = {
      "deformation: the agglomerate moves as a rigid body and breaks where a tension first reaches the pull-off force",
      "inertia of particles and fluid, and Brownian motion",
      fmt::format("self-stress of the closed contacts, up to {:.2g} pull-off forces in tension",
                  largest_self_stress(a.prepared))};
  if (restored) report.left_out.push_back("factorisation: the response of the input file was computed with this scene");
}

std::vector<std::string> describe(const Prepared& p) {
  std::vector<std::string> lines;
  lines.push_back(
      fmt::format("{} particles, {} contacts; radius scaled by {:g}; contacts closed, self-stress left {:.2g} "
                  "N rms, {:.2g} N at most",
                  p.particles.size(), p.frame.contacts.size(), p.scale, p.residual_rms, p.residual_max));
  if (p.made > 0) lines.push_back(fmt::format("{} of them are new: pairs that closing brought to overlap", p.made));
  for (std::size_t k = 0; k < std::min<std::size_t>(p.lost.size(), 5); ++k)
    lines.push_back(fmt::format("contact lost in closing: {}-{}, gap {:.3g} nm{}", p.lost[k].i, p.lost[k].j,
                                1e9 * p.lost[k].gap,
                                k == 4 && p.lost.size() > 5 ? fmt::format(" (and {} more)", p.lost.size() - 5) : ""));
  return lines;
}

namespace {

// A line of the table: the same for people, for CSV, and for the answer to --at.
struct Row {
  std::string flow, what;  // what: of the flow is meant
  double tension = 0, use = 0;
  std::string_view device;
  std::string name() const { return flow + ", " + what; }
};

std::vector<Row> table(const Numbers& n) {
  std::vector<Row> rows;
  const auto straining = [&](const std::string& flow, const std::optional<StrainingResult>& r) {
    if (!r) return;
    if (const Attractor* rest = settled(*r))
      rows.push_back({flow, fmt::format("settled ({:.0f} %)", 100 * rest->share), rest->peak.tension, rest->peak.use,
                      device_of(flow)});
    rows.push_back({flow, "worst orientation", r->worst.tension, r->worst.use,
                    device_of(flow == "elongation" ? "turbulence" : flow)});
  };
  straining("elongation", n.body.elongation);
  straining("uniaxial", n.body.uniaxial);
  straining("biaxial", n.body.biaxial);
  if (const auto& r = n.body.shear) {
    double use = 0;
    for (const Orbit& orbit : r->orbits) use += orbit.peak.use / static_cast<double>(r->orbits.size());
    const Peak& worst = r->orbits[r->worst_orbit].peak;
    rows.push_back(
        {"shear", fmt::format("mean over {} orbits", r->orbits.size()), r->mean_peak_tension, use, device_of("shear")});
    rows.push_back({"shear", "worst orbit", worst.tension, worst.use, device_of("shear")});
  }
  return rows;
}

}  // namespace

std::string result_text(const Analysis& a, const StressScene& scene) {
  const Numbers n(a, scene);
  std::string text;
  text += fmt::format("hydrodynamics {}\n", a.method);
  text += a.error ? fmt::format("largest tension within {:.2g} % ({})\n", 100 * *a.error, a.how)
                  : fmt::format("error of the largest tension {}\n", a.how);
  const MobilityNumbers m = mobility_numbers(n.body.loaded.response.drag);
  text += fmt::format("hydrodynamic radius {:.4f} a\n\n", m.hydrodynamic_radius / n.a);
  text += fmt::format("{:<34}{:>8}{:>12}{:>14}  {}\n", "N_max/(6 pi mu gamma_dot a^2)", "", "breaks, Pa",
                      "that is, 1/s", "as in");
  for (const Row& row : table(n)) {
    const double stress = 1 / row.use;
    text += fmt::format("{:<34}{:8.3f}", row.name(), row.tension / n.force);
    text += row.use > 0 ? fmt::format("{:12.0f}{:14.3g}", stress, n.liquid.shear_rate(stress))
                        : fmt::format("{:>12}{:>14}", "never", "-");
    text += fmt::format("  {}\n", row.device);
  }
  if (const auto& r = n.body.shear) {
    if (r->mean_error)
      text +=
          fmt::format("{:<34}{:8.1f} %, standard error\n", "shear, mean over orbits: known to", 100 * *r->mean_error);
    text += fmt::format("{:<34}{:8.3f}\n", "shear, mean over time", r->mean_tension / n.force);
    text += fmt::format("{:<34}{:8.2f} 1/gamma_dot\n", "shear, mean tumbling time", r->mean_tumbling_time);
  }
  text += fmt::format("1/s: shear rate sqrt(2 E:E) in this liquid of {:g} Pa s{}\n", n.liquid.viscosity,
                      n.body.uniaxial || n.body.biaxial ? "; a uniaxial extension rate times sqrt(3)" : "");
  if (const auto& r = n.body.history) {
    const Orbit& worst = r->orbits[r->worst_orbit];
    const double use = scene.liquid.viscosity * worst.peak.use;
    text += fmt::format("history: {:.3g} % of the pull-off force at t = {:g} s{}\n", 100 * use,
                        worst.time[worst.peak_at], use >= 1 ? ": it breaks" : "");
  }
  if (const auto& r = n.body.exits) {
    const double here = scene.liquid.viscosity * r->rms_rate * n.body.worst.use;  // the level of this liquid
    text += fmt::format("{} tracks, sqrt(<2 E:E>) = {:.3g} 1/s: {:.3g} of the strength in this liquid\n",
                        r->duration.size(), r->rms_rate, here);
    text += fmt::format("{:<34}{:>8}{:>8}\n", "rms stress over strength", "broken", "of them at once");
    for (std::size_t k = 0; k < r->level.size(); k += 4) {
      std::size_t broken = 0, born = 0;
      for (std::size_t track = 0; track < r->duration.size(); ++track) {
        broken += std::isfinite(r->at(track, k));
        born += r->at(track, k) == 0;
      }
      text += fmt::format("{:<34.3g}{:>8}{:>8}\n", r->level[k], broken, born);
    }
  }
  return text;
}

GranuleStrength granule_strength(const Analysis& a, const StressScene& scene, const Scene& text) {
  const Numbers n(a, scene);
  GranuleStrength s;
  s.borne = std::numeric_limits<double>::infinity();
  for (const Row& row : table(n)) {
    if (!s.stress || (row.use > 0 && 1 / row.use < *s.stress)) s.flow = row.name();
    if (row.use > 0) s.stress = std::min(s.stress.value_or(1 / row.use), 1 / row.use);
  }
  if (s.flow.empty()) throw InputError("--at: the scene has no flow to compare with; set flow.elongation = true");
  s.error = a.error;
  s.how = a.how;
  s.surface_energy = scene.material.surface_energy;
  s.surface_energy_from = source_of(text, "material.surface_energy");
  const Particles& p = a.prepared.particles;
  s.diameter = radial_extent(a.prepared.frame.position, p.radius, p.mass).diameter();
  return s;
}

}  // namespace crumble::rigidstress
