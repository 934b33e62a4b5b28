#include "dryer/result.hpp"

#include <fmt/core.h>

#include <cmath>

#include "dryer/drag.hpp"
#include "dryer/thermal_loads.hpp"

namespace crumble::dryer {

void append_frame(FrameLog& frames, const DryingRun& run) {
  const auto surface = run.surface();
  const Frame& now = run.state().state;
  frames.append(now, {{"droplet_radius", run.droplet_radius()},
                      {"wetted_count", static_cast<double>(surface.wetted)},
                      {"capillary_force", surface.largest_force}});
  if (const auto temperature = run.temperature())
    frames.sample(now.step, now.time, {{"droplet_temperature", "K", *temperature}});
}

void write_morphology(AgglomerateWriter& writer, const Morphology& m) {
  const std::string method = "farthest and nearest tenth of the particles (Vasquez Giuliano et al. 2022, section 3.1)";
  writer.put("/morphology/diameter", m.extent.diameter(), method);
  writer.put("/morphology/crust_thickness", m.extent.crust_thickness(), method);
  writer.put("/morphology/void_radius", m.extent.inner, method);
  writer.put("/morphology/porosity", m.porosity, "void fraction within the outer radius");
}

namespace {

double relative(double value, double reference) { return std::abs(value - reference) / std::abs(reference); }

// Relative; nothing where there was no companion run.
struct DryingErrors {
  std::optional<double> d_c, h_c_over_d_c, contacts;
};

DryingErrors errors(const Morphology& m, const std::optional<DryingOutcome>& companion) {
  if (!companion) return {};
  DryingErrors e{relative(companion->d_c, m.extent.diameter()),
                 relative(companion->h_c_over_d_c, m.extent.relative_crust()), std::nullopt};
  if (m.contacts > 0) e.contacts = relative(companion->contacts, static_cast<double>(m.contacts));
  return e;
}

void fill_left_out(Report& report, const DryingScene& scene, const DryingRun& run) {
  const auto& s = run.integrator().statistics();
  const double spared = 100 * (1 - static_cast<double>(s.particle_steps) /
                                       (static_cast<double>(s.steps) * static_cast<double>(scene.radius.size())));
  if (scene.model.thermal_energy == 0) {
    report.left_out.push_back(fmt::format(
        "idle particles: {:.0f} % of all particle steps were not computed, since without Brownian motion no force "
        "acts before the front or a bond arrives",
        spared));
    report.left_out.push_back(
        "Brownian motion: no diffusion (Pe = infinity), no random number is drawn after the start");
  } else if (scene.is(IntegratorKind::brownian)) {
    report.left_out.push_back(
        fmt::format("short steps: {:.0f} % of the particle time went in long steps, far from any contact", spared));
  } else if (scene.is(IntegratorKind::stabilised)) {
    const double a = scene.smallest_radius();
    const BondLaw law(scene.model.contact, scene.model.material, a, a);
    report.left_out.push_back(fmt::format(
        "free particles: {:.0f} % of all particle steps were not computed, where no bond, neighbour or surface is near",
        spared));
    report.left_out.push_back(fmt::format(
        "thermal vibration of bonds: motion that relaxes in less than {:.2g} s has less than kT; that of the normal "
        "distance is sqrt(kT/k_n) = {:.2g} nm",
        ThermalLoads::interval(scene.model, a, scene.stabilised.brownian_displacement),
        1e9 * std::sqrt(scene.model.thermal_energy / law.normal_stiffness())));
  }
  if (!scene.is(IntegratorKind::inertial)) {
    const double a = scene.largest_radius(), mu = scene.model.viscosity;
    const double inertia = 2 * scene.model.material.density * a * a / (9 * mu);
    report.left_out.push_back(fmt::format("inertia: velocities relax within {:.2g} s, the liquid lives {:.2g} s",
                                          inertia, scene.model.droplet.lifetime));
  }
  report.left_out.push_back(scene.model.surface_forces
                                ? "hydrodynamic interaction between particles: free draining (paper, section 2.1), no "
                                  "lubrication, which slows "
                                  "the approach down (stability ratio with and without it in surface_forces_at_start)"
                                : "hydrodynamic interaction between particles: free draining (paper, section 2.1); "
                                  "lubrication and attraction "
                                  "before contact: opposite effects, both neglected as in the paper");
}

}  // namespace

void write_errors(AgglomerateWriter& writer, const Morphology& m, const std::optional<DryingOutcome>& companion) {
  const std::string how = "difference to the same run with doubled step control";
  const DryingErrors e = errors(m, companion);
  if (e.d_c) writer.put("/errors/d_c", *e.d_c, how);
  if (e.h_c_over_d_c) writer.put("/errors/h_c_over_d_c", *e.h_c_over_d_c, how);
  if (e.contacts) writer.put("/errors/contacts", *e.contacts, how);
}

void fill_report(Report& report, const DryingScene& scene, const DryingRun& run, const Morphology& m,
                 const std::optional<DryingOutcome>& companion) {
  const auto& s = run.integrator().statistics();
  report.steps = s.steps;
  report.result("d_c_nm", m.extent.diameter() * 1e9);
  report.result("h_c_over_d_c", m.extent.relative_crust());
  report.result("contacts", m.contacts);
  report.result("coordination", m.coordination);
  report.result("fragments", m.fragments);
  report.result("radius_of_gyration_nm", m.radius_of_gyration * 1e9);
  report.result("contacts_within_0_02_a", m.touching);
  report.result("porosity", m.porosity);
  report.result("drying_time_s", run.state().state.time);
  report.result("contacts_made", s.contacts_made);
  report.result("contacts_lost", s.contacts_lost);
  report.result("particle_steps", s.particle_steps);
  if (const auto salt = run.integrator().ionic_strength()) report.result("last_ionic_strength_mol_per_m3", *salt);

  report.error("largest_overlap_over_a", s.largest_overlap,
               "deepest overlap of two bonded particles at the end of any step");
  const std::string how =
      companion ? "difference to the same run with doubled step control"
      : scene.model.thermal_energy > 0
          ? "not estimated: with noise, runs of different steps part; the error of means over seeds is in the manual"
          : "not estimated: error.estimate = false";
  const DryingErrors e = errors(m, companion);
  report.error("d_c_relative", e.d_c, how);
  report.error("h_c_over_d_c",
               e.h_c_over_d_c ? std::optional(*e.h_c_over_d_c * m.extent.relative_crust()) : std::nullopt, how);
  report.error("contacts_relative", e.contacts, e.contacts || !companion ? how : "not estimated: no contacts");
  fill_left_out(report, scene, run);
}

std::string result_text(const Morphology& m, const std::optional<DryingOutcome>& companion) {
  const auto error = [&](double value, double other, int digits) {
    return companion ? fmt::format(" ± {:.{}f}", std::abs(value - other), digits) : std::string();
  };
  const DryingOutcome other = companion.value_or(DryingOutcome{});
  std::string text;
  text += fmt::format("d_c           {:.2f}{} nm\n", m.extent.diameter() * 1e9,
                      error(m.extent.diameter() * 1e9, other.d_c * 1e9, 2));
  text += fmt::format("h_c/d_c       {:.4f}{}\n", m.extent.relative_crust(),
                      error(m.extent.relative_crust(), other.h_c_over_d_c, 4));
  text += fmt::format("contacts      {}{}\n", m.contacts, error(static_cast<double>(m.contacts), other.contacts, 0));
  text += fmt::format("coordination  {:.3f}\n", m.coordination);
  text += fmt::format("fragments     {}\n", m.fragments);
  if (companion) text += "±: difference to the same run with doubled step control\n";
  return text;
}

}  // namespace crumble::dryer
