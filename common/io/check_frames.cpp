// Frame by frame: are the contacts those of the positions, and is what follows from both what the file says?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/contact/material.hpp"
#include "common/io/check_values.hpp"

namespace crumble::check {

namespace {

const std::string positions = "/particles/all/position";

// Of a radius: integrators that move particles in single precision leave 2e-7.
constexpr double geometry_tolerance = 1e-5;
// Of what is computed from positions in nm instead of m; semi-axes are roots of small differences.
constexpr double rounding = 1e-6;

struct Reading {
  const Context& context;
  std::vector<double> radius, mass;  // nm, kg
  bool by_jkr;                       // else the gap does not tell the force
};

std::vector<Vector3> vectors(const Context& context, const std::string& path, std::uint64_t first,
                             std::uint64_t count) {
  const auto values = context.root.dataset(path).read_rows<double>(first, count);
  std::vector<Vector3> result(values.size() / 3);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = {values[3 * k], values[3 * k + 1], values[3 * k + 2]};
  return result;
}

// Two particles at one place: no contact overlaps by nine tenths of the radii.
bool separate(const Reading& file, std::size_t t, const std::vector<Vector3>& x) {
  constexpr double nearest = 0.1;
  const auto& a = file.radius;
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return x[i].x() < x[j].x(); });
  const double reach = 2 * nearest * *std::max_element(a.begin(), a.end());
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t l = k + 1; l < order.size() && x[order[l]].x() - x[order[k]].x() < reach; ++l) {
      const auto [i, j] = std::minmax(order[k], order[l]);
      const double distance = (x[j] - x[i]).norm();
      if (distance >= nearest * (a[i] + a[j])) continue;
      file.context.add(fmt::format("{}/value[{}][{}]", positions, t, j),
                       fmt::format("particles beside each other (radii {:g} and {:g} nm)", a[i], a[j]),
                       fmt::format("{:g} nm from particle {}", distance, i));
      return false;
    }
  return true;
}

struct Rows {
  std::uint64_t first;
  std::vector<std::int32_t> pair;
  std::size_t size() const { return pair.size() / 2; }
  std::size_t i(std::size_t k) const { return static_cast<std::size_t>(pair[2 * k]); }
  std::size_t j(std::size_t k) const { return static_cast<std::size_t>(pair[2 * k + 1]); }
};

double pair_radius_nm(const Reading& file, const Rows& rows, std::size_t k) {
  return pair_radius(file.radius[rows.i(k)], file.radius[rows.j(k)]);
}

bool fits_positions(const Reading& file, const std::vector<Vector3>& x, const Rows& rows) {
  const auto gap = file.context.root.dataset("/contacts/gap").read_rows<double>(rows.first, rows.size());
  const auto normal = vectors(file.context, "/contacts/normal", rows.first, rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Vector3 line = x[rows.j(k)] - x[rows.i(k)];
    const double a = pair_radius_nm(file, rows, k), distance = line.norm();
    const double surfaces = distance - file.radius[rows.i(k)] - file.radius[rows.j(k)];
    // Far from the origin the positions themselves are rounded.
    const double allowed = geometry_tolerance * a + 1e-12 * (x[rows.i(k)].norm() + x[rows.j(k)].norm());
    if (!(std::abs(gap[k] - surfaces) <= allowed)) {
      file.context.add(
          row("/contacts/gap", rows.first + k),
          fmt::format("{:.9g}, the distance between the surfaces of {} and {}", surfaces, rows.i(k), rows.j(k)),
          fmt::format("{:.9g}", gap[k]));
      return false;
    }
    if (gap[k] > a) {
      file.context.add(row("/contacts/gap", rows.first + k),
                       fmt::format("less than a radius, {:g} nm: beyond that no contact holds", a),
                       fmt::format("{:g}", gap[k]));
      return false;
    }
    if (!((normal[k] - line / distance).norm() <= allowed / a + geometry_tolerance)) {
      const Vector3 n = line / distance;
      file.context.add(row("/contacts/normal", rows.first + k),
                       fmt::format("{:.6f} {:.6f} {:.6f}, from {} to {}", n.x(), n.y(), n.z(), rows.i(k), rows.j(k)),
                       fmt::format("{:.6f} {:.6f} {:.6f}", normal[k].x(), normal[k].y(), normal[k].z()));
      return false;
    }
  }
  return true;
}

// Displacements, angles, forces and torques that the schema says are across the normal.
void across_the_normal(const Reading& file, const Rows& rows) {
  constexpr double tolerance = 1e-4;
  const auto normal = vectors(file.context, "/contacts/normal", rows.first, rows.size());
  for (const char* name : {"sliding", "rolling", "sliding_force", "rolling_torque"}) {
    const std::string path = std::string("/contacts/") + name;
    if (!file.context.has(path)) continue;
    const auto values = vectors(file.context, path, rows.first, rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double along = std::abs(values[k].dot(normal[k])), size = values[k].norm();
      if (along <= tolerance * size || !std::isfinite(size)) continue;
      file.context.add(row(path, rows.first + k), "a vector across the normal",
                       fmt::format("{:.3g} of it along the normal", along / size));
      break;
    }
  }
}

// By JKR the force of a pair, over its radius, is one rising function of the gap over the cube root of the radius,
// whatever the material, up to the pull-off force; from there to the rupture of a contact it falls to 5/9 of that.
void forces_fit_gaps(const Reading& file, const Rows& rows) {
  if (!file.by_jkr || !file.context.has("/contacts/normal_force")) return;
  constexpr double least = 1e-6;  // N/m, force over radius: below it the forces of closed contacts are rounding
  constexpr double tolerance = 1e-3, falling = 0.5;
  const auto gap = file.context.root.dataset("/contacts/gap").read_rows<double>(rows.first, rows.size());
  const auto force = file.context.root.dataset("/contacts/normal_force").read_rows<double>(rows.first, rows.size());
  struct Point {
    double gap, force;
    std::size_t k;
  };
  std::vector<Point> points;
  double largest = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double a = pair_radius_nm(file, rows, k);
    points.push_back({gap[k] / std::cbrt(a), force[k] / (1e-9 * a), k});
    largest = std::max(largest, std::abs(points.back().force));
  }
  if (!(largest > least)) return;
  std::sort(points.begin(), points.end(), [](const Point& p, const Point& q) { return p.gap < q.gap; });
  const Point* highest = nullptr;
  for (const Point& p : points) {
    const bool fits = !highest || p.force >= highest->force - tolerance * largest || p.force > falling * highest->force;
    if (!fits) {
      file.context.add(row("/contacts/normal_force", rows.first + p.k),
                       fmt::format("at least the {:.6g} that JKR makes of row {} at a smaller gap",
                                   highest->force * 1e-9 * pair_radius_nm(file, rows, p.k), rows.first + highest->k),
                       fmt::format("{:.6g}", force[p.k]));
      return;
    }
    if (!highest || p.force > highest->force) highest = &p;
  }
}

void expect(const Reading& file, const std::string& path, std::size_t t, double expected, double scale) {
  if (!file.context.has(path)) return;
  const double found = file.context.root.dataset(path + "/value").read_rows<double>(t, 1).front();
  if (!(std::abs(found - expected) <= rounding * scale))
    file.context.add(row(path + "/value", t), fmt::format("{:.9g}", expected), fmt::format("{:.9g}", found));
}

void observables_follow(const Reading& file, std::size_t t, const std::vector<Vector3>& x, const Rows& rows) {
  const Context& context = file.context;
  const double gyration = radius_of_gyration(x, file.mass);
  const double size = *std::max_element(file.radius.begin(), file.radius.end()) + gyration;
  expect(file, "/observables/radius_of_gyration", t, gyration, size);
  if (const std::string path = "/observables/semi_axes"; context.has(path)) {
    const auto axes = semi_axes(x, file.radius, file.mass);
    const auto found = context.root.dataset(path + "/value").read_rows<double>(t, 1);
    for (std::size_t d = 0; d < axes.size(); ++d)
      if (!(std::abs(found[d] - axes[d]) <= rounding * axes[0])) {
        context.add(fmt::format("{}/value[{}][{}]", path, t, d), fmt::format("{:.9g}", axes[d]),
                    fmt::format("{:.9g}", found[d]));
        break;
      }
  }
  const auto flags = context.has("/contacts/flags")
                         ? context.root.dataset("/contacts/flags").read_rows<std::uint8_t>(rows.first, rows.size())
                         : std::vector<std::uint8_t>{};
  for (std::size_t k = 0; k < flags.size(); ++k)
    if (flags[k] > 7) {
      context.add(row("/contacts/flags", rows.first + k), "bits 0 to 2", std::to_string(flags[k]));
      break;
    }
  for (const char* name : {"slipping_count", "rolling_count", "wetted_count"}) {
    const std::string path = std::string("/observables/") + name;
    if (!context.has(path)) continue;
    const auto most = static_cast<std::int64_t>(path.ends_with("wetted_count") ? x.size() : rows.size());
    const auto found = context.root.dataset(path + "/value").read_rows<std::int64_t>(t, 1).front();
    if (found < 0 || found > most)
      context.add(row(path + "/value", t), fmt::format("0 to {}", most), std::to_string(found));
  }
}

void labels_follow(const Reading& file, std::size_t t, const Rows& rows) {
  const std::string path = "/particles/all/fragment";
  if (!file.context.has(path)) return;
  std::vector<Contact> contacts(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    contacts[k].i = rows.pair[2 * k];
    contacts[k].j = rows.pair[2 * k + 1];
  }
  const auto expected = fragments(file.radius.size(), contacts);
  const auto found = file.context.root.dataset(path + "/value").read_rows<std::int32_t>(t, 1);
  for (std::size_t p = 0; p < found.size(); ++p)
    if (found[p] != expected[p])
      return file.context.add(fmt::format("{}/value[{}][{}]", path, t, p),
                              fmt::format("{}, the part that its contacts put it in", expected[p]),
                              std::to_string(found[p]));
}

void born_in_time(const Context& context, const std::string& stage, std::int64_t step, const Rows& rows) {
  if (!context.has("/contacts/born")) return;
  const auto born = context.root.dataset("/contacts/born").read_rows<std::int64_t>(rows.first, rows.size());
  for (std::size_t k = 0; k < born.size(); ++k)
    // The contacts that a breakup goes on with were made in the steps of the file before.
    if (born[k] < 0 || (stage == "dryer" && born[k] > step))
      return context.add(row("/contacts/born", rows.first + k), fmt::format("a step from 0 to {}", step),
                         std::to_string(born[k]));
}

}  // namespace

void frames(const Context& context) {
  for (const char* path : {"/particles/all/radius", "/particles/all/mass", "/particles/all/position",
                           "/contacts/offset", "/contacts/pair", "/contacts/gap", "/contacts/normal"})
    if (!context.has(path)) return;
  if (context.sizes.of("N") == 0) return;
  const auto root_text = [&](const char* path) {
    return context.has(path) ? context.root.dataset(path).read_text() : std::string();
  };
  const Reading file{context, context.root.dataset("/particles/all/radius").read<double>(),
                     context.root.dataset("/particles/all/mass").read<double>(),
                     root_text("/parameters/resolved").find("cundall-strack\"") == std::string::npos};
  const std::string stage = context.root.group("/h5md/modules/agglomerate").text_attribute("stage").at(0);
  const auto offsets = context.root.dataset("/contacts/offset").read<std::int64_t>();
  const auto steps = context.root.dataset(positions + "/step").read<std::int64_t>();
  for (std::size_t t = 0; t < steps.size() && context.violations.empty(); ++t) {
    const auto first = static_cast<std::uint64_t>(offsets[t]);
    const std::uint64_t count = static_cast<std::uint64_t>(offsets[t + 1]) - first;
    const Rows rows{first, context.root.dataset("/contacts/pair").read_rows<std::int32_t>(first, count)};
    const auto x = vectors(context, positions + "/value", t, 1);
    if (!separate(file, t, x) || !fits_positions(file, x, rows)) return;
    across_the_normal(file, rows);
    forces_fit_gaps(file, rows);
    observables_follow(file, t, x, rows);
    labels_follow(file, t, rows);
    born_in_time(context, stage, steps[t], rows);
  }
}

}  // namespace crumble::check
