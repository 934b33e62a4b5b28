#include "rigidstress/prepared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/contact/jkr.hpp"
#include "common/contact/small_contact.hpp"
#include "common/io/errors.hpp"

namespace crumble {

namespace {

double gap(const Particles& particles, const Frame& frame, const Contact& c) {
  return (frame.position[c.j] - frame.position[c.i]).norm() - particles.radius[c.i] - particles.radius[c.j];
}

void refuse_open_contacts(const Particles& particles, const Frame& frame, const std::string& name, double largest) {
  for (const Contact& c : frame.contacts) {
    const double h = gap(particles, frame, c), a = pair_radius(particles.radius[c.i], particles.radius[c.j]);
    if (h > largest * a)
      throw InputError(
          fmt::format("{}: contact {}-{}: the surfaces are {:.3g} a apart, more than structure.largest_gap = "
                      "{:g} a: this cannot be a contact",
                      name, c.i, c.j, h / a, largest));
  }
}

}  // namespace

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
                 const Material& material, double largest_gap) {
  Prepared p;
  p.particles = agglomerate.particles;
  Frame frame = agglomerate.state;
  frame.step = 0;
  frame.time = 0;
  frame.orientation.clear();
  if (radius) p.scale = *radius / mean_radius(p.particles);
  for (double& a : p.particles.radius) a *= p.scale;
  for (double& m : p.particles.mass) m *= p.scale * p.scale * p.scale;
  for (Vector3& x : frame.position) x *= p.scale;
  for (Contact& c : frame.contacts) c.born = 0;
  const double smallest = *std::min_element(p.particles.radius.begin(), p.particles.radius.end());
  if (const auto wrong = outside_contact_theory(material, smallest); !wrong.empty())
    throw InputError("material.youngs_modulus " + wrong);
  refuse_open_contacts(p.particles, frame, name, largest_gap);

  Closed closed = close_all_contacts(p.particles, frame, material, p.made);
  if (!closed.converged)
    throw std::runtime_error(
        fmt::format("{}: closing the contacts did not converge in {} steps: is the contact list "
                    "that of these positions?",
                    name, closed.iterations));
  p.frame = std::move(closed.frame);
  p.lost = std::move(closed.lost);
  p.largest_tension = closed.tension_max;
  double squares = 0;
  for (const Contact& c : p.frame.contacts) {
    squares += c.normal_force * c.normal_force;
    p.residual_max = std::max(p.residual_max, std::abs(c.normal_force));
  }
  if (!p.frame.contacts.empty()) p.residual_rms = std::sqrt(squares / static_cast<double>(p.frame.contacts.size()));
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

std::vector<double> pull_off_of(const Prepared& p, const Body& body, const Material& material) {
  std::vector<double> force;
  for (const int b : body.contact) {
    const Contact& c = p.frame.contacts[b];
    force.push_back(pull_off_force(material, pair_radius(p.particles.radius[c.i], p.particles.radius[c.j])));
  }
  return force;
}

}  // namespace crumble
