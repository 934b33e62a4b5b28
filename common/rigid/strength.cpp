#include "common/rigid/strength.hpp"

#include <numbers>

#include "common/agglomerate/morphology.hpp"
#include "common/contact/jkr.hpp"
#include "common/hydro/dense_hydrodynamics.hpp"
#include "common/rigid/response.hpp"

namespace crumble {

double rigid_strength(const Agglomerate& g, const Material& material, const JointChoice& choice,
                      const HydroModel& hydro, const Eigen::Matrix3d& gradient) {
  const std::vector<double>& radius = g.particles.radius;
  const double a = mean_radius(g.particles), by_drag = pull_off_force(material, a) / (6 * std::numbers::pi * a * a);
  if (g.state.contacts.empty()) return by_drag;
  std::vector<Joint> joints;
  std::vector<double> pull_off;
  for (const Contact& c : g.state.contacts) {
    joints.push_back(make_joint(choice, material, c.i, c.j, radius[c.i], radius[c.j]));
    pull_off.push_back(pull_off_force(material, pair_radius(radius[c.i], radius[c.j])));
  }
  constexpr double viscosity = 1;  // Pa s: tensions are those at a flow stress of 1 Pa
  const Network network(g.state.position, radius, std::move(joints));
  const DenseHydrodynamics hydrodynamics({g.state.position, radius}, viscosity, hydro);
  const Vector3 centre = centre_of_mass(g.state.position, g.particles.mass);
  const Response response = respond(network, rigid_body_response(hydrodynamics, g.state.position, centre));
  const WorstContact worst = worst_contact(response.tension, pull_off, gradient);
  return worst.contact >= 0 && worst.tension > 0 ? pull_off[worst.contact] / worst.tension : by_drag;
}

}  // namespace crumble
