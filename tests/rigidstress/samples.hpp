// Small clusters of known answers, of spheres of 100 nm with the material of the paper's Table 1.
#pragma once

#include <numbers>
#include <utility>

#include "common/hydro/dense_hydrodynamics.hpp"
#include "common/numerics/noise.hpp"
#include "common/rigid/response.hpp"

namespace crumble::testing {

inline constexpr double radius = 1e-7;

using Pairs = std::vector<std::pair<int, int>>;

struct Cluster {
  std::vector<Vector3> position;  // in radii
  Pairs pairs;
};

inline Cluster chain(int n) {
  Cluster c;
  for (int i = 0; i < n; ++i) {
    c.position.emplace_back(2.0 * i, 0, 0);
    if (i) c.pairs.emplace_back(i - 1, i);
  }
  return c;
}

// Every pair closer than 2 + tolerance radii is a contact.
inline Cluster touching(std::vector<Vector3> position, double tolerance = 1e-9) {
  Cluster c{std::move(position), {}};
  const int n = static_cast<int>(c.position.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      if ((c.position[j] - c.position[i]).norm() < 2 + tolerance) c.pairs.emplace_back(i, j);
  return c;
}

inline Cluster triangle() { return touching({{-1, 0, 0}, {1, 0, 0}, {0, std::sqrt(3.0), 0}}); }

inline Cluster tetrahedron() {
  const double c = std::sqrt(0.5);
  return touching({{c, c, c}, {c, -c, -c}, {-c, c, -c}, {-c, -c, c}});
}

inline Cluster octahedron() {
  const double c = std::sqrt(2.0);
  return touching({{c, 0, 0}, {-c, 0, 0}, {0, c, 0}, {0, -c, 0}, {0, 0, c}, {0, 0, -c}});
}

// Square lattice in the plane z = 0.
inline Cluster raft(int side) {
  std::vector<Vector3> position;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) position.emplace_back(2.0 * i, 2.0 * j, 0);
  return touching(std::move(position));
}

inline std::vector<Vector3> in_metres(const Cluster& cluster, double a = radius) {
  std::vector<Vector3> position = cluster.position;
  for (Vector3& x : position) x *= a;
  return position;
}

inline Network network(const Cluster& cluster, const JointChoice& choice = {}) {
  std::vector<Joint> joints;
  for (const auto& [i, j] : cluster.pairs) joints.push_back(make_joint(choice, Material{}, i, j, radius, radius));
  return {in_metres(cluster), std::vector<double>(cluster.position.size(), radius), std::move(joints)};
}

inline Vector3 centre(const std::vector<Vector3>& position) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& x : position) sum += x;
  return sum / static_cast<double>(position.size());
}

// Viscosity 1 Pa s.
inline Response response(const Network& network, const HydroModel& model) {
  const Spheres spheres{network.position(), network.radius()};
  const DenseHydrodynamics hydrodynamics(spheres, 1, model);
  return respond(network, rigid_body_response(hydrodynamics, network.position(), centre(network.position())));
}

}  // namespace crumble::testing
