#include "common/agglomerate/import.hpp"

#include <algorithm>
#include <numbers>
#include <sstream>
#include <string>

#include "common/contact/jkr.hpp"

namespace crumble {
namespace {

std::vector<double> radii(const PointList& points, const ImportOptions& options) {
  if (points.radius.empty() && !options.radius) {
    throw PointListError(points.file +
                         ": has no column of radii or diameters: give the radius of all spheres (--radius)");
  }
  if (!points.radius.empty() && options.radius) {
    throw PointListError(points.file + ": has radii of its own: leave --radius out");
  }
  if (options.radius) return std::vector<double>(points.position.size(), *options.radius);
  std::vector<double> radius = points.radius;
  for (double& a : radius) a *= options.unit;
  return radius;
}

// Colloids in the metre range are a forgotten unit, and so are particles smaller than an atom.
void check_size(const PointList& points, const Frame& frame, const std::vector<double>& radius) {
  constexpr double largest = 1, smallest_radius = 1e-10, largest_radius = 1e-3;  // m
  for (std::size_t i = 0; i < radius.size(); ++i) {
    if (frame.position[i].cwiseAbs().maxCoeff() > largest || radius[i] > largest) {
      throw PointListError(points.file + ":" + std::to_string(points.line[i]) +
                           ": a length is larger than 1 m: check --unit");
    }
    if (!(radius[i] >= smallest_radius && radius[i] <= largest_radius)) {
      std::ostringstream found;
      found << radius[i];
      throw PointListError(points.file + ":" + std::to_string(points.line[i]) + ": a radius of " + found.str() +
                           " m, which no particle of a colloid has: check --unit and --radius");
    }
  }
}

Particles particles_of(std::vector<double> radius, double density) {
  Particles p;
  for (double a : radius) p.mass.push_back(density * 4 * std::numbers::pi / 3 * a * a * a);
  for (std::size_t i = 0; i < radius.size(); ++i) p.id.push_back(static_cast<std::int64_t>(i));
  p.species.assign(radius.size(), 0);
  p.radius = std::move(radius);
  return p;
}

// The first few of many complaints, each on a line of its own.
class Complaints {
 public:
  explicit Complaints(std::string file) : file_(std::move(file)) {}
  void add(int first_line, int second_line, const std::string& what) {
    constexpr int shown = 10;
    if (++count_ <= shown) {
      text_ += (text_.empty() ? "" : "\n") + file_ + ":" + std::to_string(std::max(first_line, second_line)) + ": " +
               what + " (the other on line " + std::to_string(std::min(first_line, second_line)) + ")";
    }
    if (count_ == shown + 1) text_ += "\n" + file_ + ": and more such pairs";
  }
  void raise() const {
    if (count_ > 0) throw PointListError(text_);
  }

 private:
  std::string file_, text_;
  int count_ = 0;
};

std::string per_cent_of_radius(double gap, double a) {
  const int tenths = static_cast<int>(-1000 * gap / a + 0.5);
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " % of the radius";
}

}  // namespace

Imported import_points(const PointList& points, const ImportOptions& options) {
  Imported result;
  Particles particles = particles_of(radii(points, options), options.material.density);
  const std::vector<double>& radius = particles.radius;
  Frame frame;
  for (const Vector3& x : points.position) frame.position.push_back(options.unit * x);
  check_size(points, frame, radius);

  Complaints complaints(points.file);
  for (const NearPair& pair : near_pairs(frame.position, radius, options.contact_tolerance)) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    const double a = pair_radius(radius[i], radius[j]);
    const double deepest = Jkr(options.material, a).equilibrium_gap - options.contact_tolerance * a;
    if (frame.position[i] == frame.position[j]) {
      complaints.add(points.line[i], points.line[j], "two spheres have the same centre");
    } else if (pair.gap < deepest) {
      complaints.add(points.line[i], points.line[j],
                     "two spheres overlap by " + per_cent_of_radius(pair.gap, a) + ", allowed are " +
                         per_cent_of_radius(deepest, a) + ": check --radius, --unit or --contact-tolerance");
    }
    Contact contact;
    contact.i = pair.i;
    contact.j = pair.j;
    frame.contacts.push_back(contact);
  }
  complaints.raise();
  result.touching = frame.contacts.size();
  result.closed = rescaled({std::move(particles), std::move(frame)}, std::nullopt, options.material);
  return result;
}

}  // namespace crumble
