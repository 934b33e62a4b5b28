#include "breaker/start.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/contact/small_contact.hpp"
#include "common/hydro/lubrication.hpp"
#include "common/io/errors.hpp"
#include "common/rigid/strength.hpp"

namespace crumble::breaker {

namespace {

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
  g = largest_fragment(g);
}

}  // namespace

Start make_start(Agglomerate agglomerate, const std::string& name, const BreakerScene& scene) {
  Start start;
  require_one_piece(agglomerate, name, scene.only_largest);
  if (agglomerate.particles.size() == 0) throw InputError(name + ": there are no particles");
  const std::vector<double>& radius = agglomerate.particles.radius;
  const double factor = scene.radius ? *scene.radius / mean_radius(agglomerate.particles) : 1;
  if (const auto wrong =
          outside_contact_theory(scene.model.material, factor * *std::min_element(radius.begin(), radius.end()));
      !wrong.empty())
    throw InputError("material.youngs_modulus " + wrong);
  if (scene.keep_contacts) {
    start.self_stress = self_stress(agglomerate, scene.model.material);
  } else {
    if (const auto open = open_contact(agglomerate, scene.largest_gap)) throw InputError(name + ": " + *open);
    Rescaled r = rescaled(std::move(agglomerate), scene.radius, scene.model.material);
    agglomerate = std::move(r.agglomerate);
    start.scale = r.scale;
    start.closed = true;
    start.lost = r.lost.size();
    start.made = r.made;
    start.self_stress = r.self_stress;
    if (start.lost > 0) require_one_piece(agglomerate, name + ", closed,", scene.only_largest);
  }
  if (scene.model.hydro.rung != Rung::fts) {
    const Spheres spheres{agglomerate.state.position, agglomerate.particles.radius};
    if (const auto wrong = outside_lubrication(spheres, scene.model.hydro.lubrication_range); !wrong.empty())
      throw InputError(name + ": " + wrong + ". hydrodynamics.method = \"fts\" leaves it out");
  }
  Frame& frame = agglomerate.state;
  const Particles& particles = agglomerate.particles;
  frame.step = 0;
  frame.time = 0;
  for (auto* field : {&frame.velocity, &frame.angular_velocity, &frame.force, &frame.torque}) field->clear();
  if (frame.orientation.size() != particles.size()) frame.orientation.assign(particles.size(), Quaternion::Identity());
  const Vector3 centre = centre_of_mass(frame.position, particles.mass);
  for (Vector3& x : frame.position) x -= centre;
  for (Contact& c : frame.contacts) c.born = 0;
  const BreakupModel& model = scene.model;
  if (!model.gradient.isZero())
    start.rigid_strength =
        rigid_strength(agglomerate, model.material, {.bending_factor = model.contact.rolling_stiffness_factor},
                       model.hydro, model.gradient);
  start.agglomerate = std::move(agglomerate);
  return start;
}

}  // namespace crumble::breaker
