// Particles and the contact network between them: the one thing that all stages exchange.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace crumble {

using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Quaternion = Eigen::Quaterniond;

// Which springs of a bond were at their limits when it was last advanced.
namespace limit {
constexpr std::uint8_t sliding = 1, twisting = 2, rolling = 4;
}

// One bonded pair with its history. SI units; i < j; the normal points from i to j; tension is positive and
// gap > 0 means separated surfaces. The history vectors are perpendicular to the normal and rotate with it.
struct Contact {
  std::int32_t i = 0, j = 0;
  Vector3 normal = Vector3::UnitX();
  double gap = 0;                            // h, m
  Vector3 sliding = Vector3::Zero();         // elastic sliding displacement xi_s, m
  Vector3 rolling = Vector3::Zero();         // elastic rolling angle theta_r, rad
  double twisting = 0;                       // elastic twisting angle phi_t, rad
  double normal_force = 0;                   // N
  Vector3 sliding_force = Vector3::Zero();   // on j, N
  double twisting_torque = 0;                // on j along the normal, N m
  Vector3 rolling_torque = Vector3::Zero();  // on j, N m
  std::uint8_t at_limit = 0;                 // sum of those of limit::
  std::int64_t born = 0;                     // step at which the contact was made
};

// The state at one instant. All vectors have one entry a particle, or are empty where a stage does not know them.
struct Frame {
  std::int64_t step = 0;
  double time = 0;                // s
  std::vector<Vector3> position;  // m
  std::vector<Quaternion> orientation;
  std::vector<Vector3> velocity;          // m/s
  std::vector<Vector3> angular_velocity;  // rad/s
  std::vector<Vector3> force;             // N
  std::vector<Vector3> torque;            // N m
  std::vector<Contact> contacts;          // sorted by (i, j)
};

// What does not change in time.
struct Particles {
  std::vector<double> radius;         // m
  std::vector<double> mass;           // kg
  std::vector<std::int64_t> id;       // stable names, counted from 0
  std::vector<std::int32_t> species;  // 0 unless the scene has several kinds

  std::size_t size() const { return radius.size(); }
};

struct Agglomerate {
  Particles particles;
  Frame state;
};

}  // namespace crumble
