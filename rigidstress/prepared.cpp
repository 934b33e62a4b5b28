#include "rigidstress/prepared.hpp"

#include <algorithm>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/agglomerate/rescaled.hpp"
#include "common/contact/jkr.hpp"
#include "common/contact/small_contact.hpp"
#include "common/io/errors.hpp"
#include "common/surface_forces/pair_forces.hpp"

namespace crumble::rigidstress {

std::vector<Vector3> touching_positions(const Particles& particles, const Frame& frame) {
  double stretch = 0;
  for (const Contact& c : frame.contacts) {
    const double sum = particles.radius[c.i] + particles.radius[c.j];
    stretch += sum / (frame.position[c.j] - frame.position[c.i]).norm();
  }
  stretch = frame.contacts.empty() ? 1 : stretch / static_cast<double>(frame.contacts.size());
  std::vector<Vector3> position = frame.position;
  for (Vector3& x : position) x *= stretch;
  return position;
}

Prepared prepare(const Agglomerate& agglomerate, const std::string& name, std::optional<double> radius,
                 const Material& material, double largest_gap, bool only_largest) {
  const std::vector<double>& before = agglomerate.particles.radius;
  const double factor = radius ? *radius / mean_radius(agglomerate.particles) : 1;
  if (const auto wrong = outside_contact_theory(material, factor * *std::min_element(before.begin(), before.end()));
      !wrong.empty())
    throw InputError("material.youngs_modulus " + wrong);
  if (const auto open = open_contact(agglomerate, largest_gap)) throw InputError(name + ": " + *open);
  Rescaled r = rescaled(only_largest ? largest_fragment(agglomerate) : agglomerate, radius, material);
  if (only_largest && !r.lost.empty()) r.agglomerate = largest_fragment(r.agglomerate);
  Prepared p;
  p.particles = std::move(r.agglomerate.particles);
  p.frame = std::move(r.agglomerate.state);
  p.frame.orientation.clear();
  p.scale = r.scale;
  p.lost = std::move(r.lost);
  p.made = r.made;
  p.largest_tension = r.largest_tension;
  p.residual_rms = r.self_stress.rms;
  p.residual_max = r.self_stress.max;
  p.position = touching_positions(p.particles, p.frame);
  return p;
}

std::vector<Body> bodies(const Prepared& p) {
  const std::vector<std::int32_t> label = fragments(p.particles.size(), p.frame.contacts);
  std::vector<Body> result(fragment_sizes(label).size());
  for (std::size_t i = 0; i < label.size(); ++i) result[label[i]].particle.push_back(static_cast<int>(i));
  for (std::size_t b = 0; b < p.frame.contacts.size(); ++b)
    result[label[p.frame.contacts[b].i]].contact.push_back(static_cast<int>(b));
  return result;
}

Network network_of(const Prepared& p, const Body& body, const JointChoice& choice, const Material& material) {
  std::vector<int> row(p.particles.size(), -1);
  std::vector<Vector3> position;
  std::vector<double> radius;
  for (const int i : body.particle) {
    row[i] = static_cast<int>(position.size());
    position.push_back(p.position[i]);
    radius.push_back(p.particles.radius[i]);
  }
  std::vector<Joint> joints;
  for (const int b : body.contact) {
    const Contact& c = p.frame.contacts[b];
    joints.push_back(
        make_joint(choice, material, row[c.i], row[c.j], p.particles.radius[c.i], p.particles.radius[c.j]));
  }
  return {std::move(position), std::move(radius), std::move(joints)};
}

Vector3 centre_of(const Prepared& p, const Body& body) {
  Vector3 sum = Vector3::Zero();
  double mass = 0;
  for (const int i : body.particle) {
    sum += p.particles.mass[i] * p.position[i];
    mass += p.particles.mass[i];
  }
  return sum / mass;
}

std::vector<double> pull_off_of(const Prepared& p, const Body& body, const Material& material,
                                const std::optional<SurfaceForces>& surface_forces) {
  std::vector<double> force;
  const BondLaws bonds({}, material, p.particles.radius);
  std::optional<SurfaceForceLaws> in_liquid;
  if (surface_forces) in_liquid.emplace(*surface_forces, bonds, p.particles.radius);
  for (const int b : body.contact) {
    const Contact& c = p.frame.contacts[b];
    force.push_back(in_liquid
                        ? (*in_liquid)(c.i, c.j).pull_off_force()
                        : pull_off_force(material, pair_radius(p.particles.radius[c.i], p.particles.radius[c.j])));
  }
  return force;
}

}  // namespace crumble::rigidstress
