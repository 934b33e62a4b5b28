#include "common/agglomerate/morphology.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/near_pairs.hpp"

namespace crumble {
namespace {

using Positions = std::span<const Vector3>;
using Numbers = std::span<const double>;

void require_same_length(Positions position, Numbers other, const char* name) {
  if (position.empty()) throw std::invalid_argument("morphology: no particles");
  if (position.size() != other.size()) {
    throw std::invalid_argument(std::string("morphology: one ") + name + " a position is needed");
  }
}

double mean(auto first, auto last) { return std::accumulate(first, last, 0.0) / static_cast<double>(last - first); }

}  // namespace

double mean_radius(const Particles& particles) {
  if (particles.size() == 0) throw std::invalid_argument("morphology: no particles");
  const double first = particles.radius.front();
  double difference = 0;
  for (double a : particles.radius) difference += a - first;
  return first + difference / static_cast<double>(particles.size());
}

Vector3 centre_of_mass(Positions position, Numbers mass) {
  require_same_length(position, mass, "mass");
  Vector3 moment = Vector3::Zero();
  double total = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    moment += mass[i] * position[i];
    total += mass[i];
  }
  return moment / total;
}

std::vector<double> radial_positions(Positions position, Numbers mass) {
  const Vector3 centre = centre_of_mass(position, mass);
  std::vector<double> r;
  r.reserve(position.size());
  for (const Vector3& x : position) r.push_back((x - centre).norm());
  std::sort(r.begin(), r.end());
  return r;
}

std::size_t tenth(std::size_t particle_count) { return std::max<std::size_t>(1, (particle_count + 5) / 10); }

RadialExtent radial_extent(Positions position, Numbers radius, Numbers mass) {
  require_same_length(position, radius, "radius");
  const Vector3 centre = centre_of_mass(position, mass);
  std::vector<double> farthest, nearest;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const double r = (position[i] - centre).norm();
    farthest.push_back(r + radius[i]);
    nearest.push_back(r - radius[i]);
  }
  const auto count = static_cast<std::ptrdiff_t>(tenth(position.size()));
  // Sorted, not merely partitioned, so that the sums do not depend on the order of the particles.
  std::partial_sort(farthest.begin(), farthest.begin() + count, farthest.end(), std::greater<>());
  std::partial_sort(nearest.begin(), nearest.begin() + count, nearest.end());
  return {mean(farthest.begin(), farthest.begin() + count),
          std::max(0.0, mean(nearest.begin(), nearest.begin() + count))};
}

double radius_of_gyration(Positions position, Numbers mass) {
  const Vector3 centre = centre_of_mass(position, mass);
  double moment = 0, total = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    moment += mass[i] * (position[i] - centre).squaredNorm();
    total += mass[i];
  }
  return std::sqrt(moment / total);
}

std::array<double, 3> semi_axes(Positions position, Numbers radius, Numbers mass) {
  require_same_length(position, radius, "radius");
  const Vector3 centre = centre_of_mass(position, mass);
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  double own = 0, total = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Vector3 x = position[i] - centre;
    second += mass[i] * x * x.transpose();
    own += mass[i] * radius[i] * radius[i] / 5;
    total += mass[i];
  }
  // The own part is isotropic: adding it to the eigenvalues keeps thin directions exact.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(second / total, Eigen::EigenvaluesOnly);
  std::array<double, 3> axes{};
  for (Eigen::Index k = 0; k < 3; ++k) {
    axes[static_cast<std::size_t>(2 - k)] = std::sqrt(5 * (std::max(0.0, solver.eigenvalues()[k]) + own / total));
  }
  return axes;
}

double intersection_volume(double a, double b, double d) {
  if (d >= a + b) return 0;
  const double smaller = std::min(a, b);
  if (d <= std::abs(a - b)) return 4 * std::numbers::pi / 3 * smaller * smaller * smaller;
  // Two spherical caps of heights h_a, h_b on the common plane: pi h^2 (3 R - h) / 3 each.
  const double h_a = (b - a + d) * (b + a - d) / (2 * d), h_b = (a - b + d) * (a + b - d) / (2 * d);
  return std::numbers::pi / 3 * (h_a * h_a * (3 * a - h_a) + h_b * h_b * (3 * b - h_b));
}

double porosity(Positions position, Numbers radius, Numbers mass, double outer) {
  require_same_length(position, radius, "radius");
  const Vector3 centre = centre_of_mass(position, mass);
  double solid = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    solid += intersection_volume(outer, radius[i], (position[i] - centre).norm());
  }
  return 1 - solid / (4 * std::numbers::pi / 3 * outer * outer * outer);
}

double coordination_number(std::size_t particle_count, std::size_t contact_count) {
  if (particle_count == 0) throw std::invalid_argument("morphology: no particles");
  return 2 * static_cast<double>(contact_count) / static_cast<double>(particle_count);
}

std::vector<std::int32_t> coordination(std::size_t particle_count, std::span<const Contact> contacts) {
  std::vector<std::int32_t> count(particle_count, 0);
  for (const Contact& c : contacts) {
    ++count.at(static_cast<std::size_t>(c.i));
    ++count.at(static_cast<std::size_t>(c.j));
  }
  return count;
}

Morphology morphology(const Particles& particles, const Frame& frame) {
  const Positions x = frame.position;
  const Numbers a = particles.radius, m = particles.mass;
  Morphology result;
  result.particles = static_cast<std::int64_t>(x.size());
  result.centre = centre_of_mass(x, m);
  result.extent = radial_extent(x, a, m);
  result.radius_of_gyration = radius_of_gyration(x, m);
  result.semi_axes = semi_axes(x, a, m);
  result.porosity = porosity(x, a, m, result.extent.outer);
  result.contacts = static_cast<std::int64_t>(frame.contacts.size());
  result.coordination = coordination_number(x.size(), frame.contacts.size());
  const auto touching = near_pairs(x, a, touching_fraction).size();
  result.touching = static_cast<std::int64_t>(touching);
  result.coordination_touching = coordination_number(x.size(), touching);
  const auto sizes = fragment_sizes(fragments(x.size(), frame.contacts));
  result.fragments = static_cast<std::int64_t>(sizes.size());
  result.largest_fragment = sizes.front();
  return result;
}

}  // namespace crumble
