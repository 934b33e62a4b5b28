#include "breaker/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/contact/bond_laws.hpp"
#include "common/contact/small_contact.hpp"
#include "common/io/errors.hpp"

namespace crumble {

namespace {

void scale(Agglomerate& g, double factor) {
  for (double& a : g.particles.radius) a *= factor;
  for (double& m : g.particles.mass) m *= factor * factor * factor;
  for (Vector3& x : g.state.position) x *= factor;
}

void refuse_open_contacts(const Agglomerate& g, const std::string& name, double largest) {
  for (const Contact& c : g.state.contacts) {
    const double a_i = g.particles.radius[c.i], a_j = g.particles.radius[c.j], a = pair_radius(a_i, a_j);
    const double h = (g.state.position[c.j] - g.state.position[c.i]).norm() - a_i - a_j;
    if (h > largest * a)
      throw InputError(
          fmt::format("{}: contact {}-{}: the surfaces are {:.3g} a apart, more than "
                      "particle.largest_gap = {:g} a: this cannot be a contact",
                      name, c.i, c.j, h / a, largest));
  }
}

// One piece, or only the largest.
void require_one_piece(Agglomerate& g, const std::string& name, bool only_largest) {
  const auto label = fragments(g.particles.size(), g.state.contacts);
  const auto sizes = fragment_sizes(label);
  if (sizes.size() < 2) return;
  if (!only_largest)
    throw InputError(
        fmt::format("{} is in {} pieces, the largest of {} particles: there is nothing that holds them "
                    "together. particle.fragments = \"largest\" takes that one alone",
                    name, sizes.size(), sizes.front()));
  Agglomerate kept;
  std::vector<std::int32_t> number(label.size(), -1);
  for (std::size_t p = 0; p < label.size(); ++p) {
    if (label[p] != 0) continue;
    number[p] = static_cast<std::int32_t>(kept.particles.size());
    kept.particles.radius.push_back(g.particles.radius[p]);
    kept.particles.mass.push_back(g.particles.mass[p]);
    if (!g.particles.id.empty()) kept.particles.id.push_back(g.particles.id[p]);
    if (!g.particles.species.empty()) kept.particles.species.push_back(g.particles.species[p]);
    kept.state.position.push_back(g.state.position[p]);
    if (!g.state.orientation.empty()) kept.state.orientation.push_back(g.state.orientation[p]);
  }
  for (Contact c : g.state.contacts) {
    if (number[c.i] < 0) continue;
    c.i = number[c.i];
    c.j = number[c.j];
    kept.state.contacts.push_back(c);
  }
  g = std::move(kept);
}

}  // namespace

Start make_start(Agglomerate agglomerate, const std::string& name, const BreakerScene& scene) {
  Start start;
  start.agglomerate = std::move(agglomerate);
  require_one_piece(start.agglomerate, name, scene.only_largest);
  Frame& frame = start.agglomerate.state;
  const Particles& particles = start.agglomerate.particles;
  if (particles.size() == 0) throw InputError(name + ": there are no particles");
  if (scene.radius) start.scale = *scene.radius / mean_radius(particles);
  if (start.scale != 1) scale(start.agglomerate, start.scale);
  const double smallest = *std::min_element(particles.radius.begin(), particles.radius.end());
  if (const auto wrong = outside_contact_theory(scene.model.material, smallest); !wrong.empty())
    throw InputError("material.youngs_modulus " + wrong);
  if (!scene.keep_contacts) {
    refuse_open_contacts(start.agglomerate, name, scene.largest_gap);
    Closed closed = close_all_contacts(particles, frame, scene.model.material, start.made);
    if (!closed.converged)
      throw std::runtime_error(
          fmt::format("{}: closing the contacts did not converge in {} steps: is the contact "
                      "list that of these positions?",
                      name, closed.iterations));
    frame = std::move(closed.frame);
    start.closed = true;
    start.lost = closed.lost.size();
    if (start.lost > 0) require_one_piece(start.agglomerate, name + ", closed,", scene.only_largest);
  }
  frame.step = 0;
  frame.time = 0;
  for (auto* field : {&frame.velocity, &frame.angular_velocity, &frame.force, &frame.torque}) field->clear();
  if (frame.orientation.size() != particles.size()) frame.orientation.assign(particles.size(), Quaternion::Identity());
  Vector3 centre = centre_of_mass(frame.position, particles.mass);
  for (Vector3& x : frame.position) x -= centre;
  for (Contact& c : frame.contacts) c.born = 0;

  const BondLaws laws(scene.model.contact, scene.model.material, particles.radius);
  double squares = 0, uses = 0;
  for (const Contact& c : frame.contacts) {
    const double N =
        laws(c.i, c.j)
            .normal((frame.position[c.j] - frame.position[c.i]).norm() - particles.radius[c.i] - particles.radius[c.j])
            .tension;
    const double use = std::abs(N) / laws(c.i, c.j).pull_off_force();
    squares += N * N;
    uses += use * use;
    start.residual_max = std::max(start.residual_max, std::abs(N));
    start.max_use = std::max(start.max_use, use);
  }
  const double count = std::max<double>(1, static_cast<double>(frame.contacts.size()));
  start.residual_rms = std::sqrt(squares / count);
  start.rms_use = std::sqrt(uses / count);
  return start;
}

}  // namespace crumble
