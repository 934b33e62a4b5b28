#include "common/agglomerate/rescaled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/agglomerate/morphology.hpp"
#include "common/contact/bond_laws.hpp"

namespace crumble {

namespace {

double gap(const Agglomerate& g, const Contact& c) {
  return (g.state.position[c.j] - g.state.position[c.i]).norm() - g.particles.radius[c.i] - g.particles.radius[c.j];
}

}  // namespace

std::optional<std::string> open_contact(const Agglomerate& g, double largest) {
  for (const Contact& c : g.state.contacts) {
    const double h = gap(g, c), a = pair_radius(g.particles.radius[c.i], g.particles.radius[c.j]);
    if (h > largest * a)
      return fmt::format(
          "contact {}-{}: the surfaces are {:.3g} a apart, more than particle.largest_gap = {:g} a: this cannot be a "
          "contact",
          c.i, c.j, h / a, largest);
  }
  return std::nullopt;
}

SelfStress self_stress(const Agglomerate& g, const Material& material) {
  const BondLaws laws({}, material, g.particles.radius);
  SelfStress s;
  for (const Contact& c : g.state.contacts) {
    const BondLaw& law = laws(c.i, c.j);
    const double force = std::abs(law.normal(gap(g, c)).tension), use = force / law.pull_off_force();
    s.rms += force * force;
    s.rms_use += use * use;
    s.max = std::max(s.max, force);
    s.max_use = std::max(s.max_use, use);
  }
  const double count = std::max<double>(1, static_cast<double>(g.state.contacts.size()));
  s.rms = std::sqrt(s.rms / count);
  s.rms_use = std::sqrt(s.rms_use / count);
  return s;
}

Rescaled rescaled(Agglomerate g, std::optional<double> radius, const Material& material) {
  Rescaled r;
  if (radius) r.scale = *radius / mean_radius(g.particles);
  if (r.scale != 1) {
    for (double& a : g.particles.radius) a *= r.scale;
    for (double& m : g.particles.mass) m *= r.scale * r.scale * r.scale;
    for (Vector3& x : g.state.position) x *= r.scale;
  }
  g.state.step = 0;
  g.state.time = 0;
  for (Contact& c : g.state.contacts) c.born = 0;
  Closed closed = close_all_contacts(g.particles, g.state, material, r.made);
  if (!closed.converged)
    throw std::runtime_error(
        fmt::format("closing the contacts did not converge in {} steps: is the contact list that of these positions?",
                    closed.iterations));
  g.state = std::move(closed.frame);
  r.lost = std::move(closed.lost);
  r.largest_move = closed.largest_move;
  r.largest_tension = closed.tension_max;
  r.largest_compression = closed.compression_max;
  r.gap_rms = closed.residual_rms;
  r.gap_max = closed.residual_max;
  r.self_stress = self_stress(g, material);
  r.agglomerate = std::move(g);
  return r;
}

}  // namespace crumble
