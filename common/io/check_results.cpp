// Each array by itself, and what a stage found out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "common/agglomerate/morphology.hpp"
#include "common/io/check_values.hpp"

namespace crumble::check {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

// In the unit of the file; an array that is not here may hold any number.
struct Range {
  std::string_view path;  // the table's
  double low, high;
};
constexpr Range allowed[] = {
    {"/particles/all/radius", 0.1, 1e7},  // nm: from an atom to a centimetre
    {"/observables/droplet_radius", 0, none},
    {"/observables/wetted_count", 0, none},
    {"/observables/capillary_force", 0, none},
    {"/observables/flow_stress", 0, none},
    {"/observables/shear_rate", 0, none},
    {"/observables/slipping_count", 0, none},
    {"/observables/rolling_count", 0, none},
    {"/morphology/diameter", 0, none},
    {"/morphology/crust_thickness", 0, none},
    {"/morphology/porosity", 0, 1},
    {"/morphology/radial_position", 0, none},
    {"/closing/residual_rms", 0, none},
    {"/closing/residual_max", 0, none},
    {"/closing/lost_contacts", 0, none},
    {"/closing/scale", std::numeric_limits<double>::min(), none},
    {"/response/error", 0, none},
    {"/flows/<name>/radial_position", 0, none},
    {"/flows/<name>/share", 0, 1 + 1e-9},
    {"/flows/<name>/critical_stress", std::numeric_limits<double>::min(), none},
    {"/errors/<name>", 0, none},
    {"/breakup/critical_stress", 0, none},
    {"/breakup/stress", 0, none},
    {"/breakup/time", 0, none},
    {"/events/stress", 0, none},
    {"/events/kind", 0, 5},
    {"/events/fragment_sizes", 1, none},
};

template <class T>
void within(const Context& context, const std::string& path, const Range& range) {
  const auto dataset = context.root.dataset(path);
  const auto values = dataset.read<T>();
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto value = static_cast<double>(values[k]);
    if (value >= range.low && value <= range.high) continue;
    const std::string wanted = range.high < none ? fmt::format("{:g} to {:g}", range.low, range.high)
                               : range.low > 0   ? std::string("a positive number")
                                                 : std::string("0 or more");
    return context.add(place(path, dataset.shape(), k), wanted, fmt::format("{}", values[k]));
  }
}

void in_order(const Context& context, const std::string& path) {
  if (!context.has(path)) return;
  const auto values = context.root.dataset(path).read<double>();
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] >= values[k - 1]))
      return context.add(row(path, k), fmt::format("at least the {:g} before", values[k - 1]),
                         fmt::format("{:g}", values[k]));
}

void densities(const Context& context) {
  const std::string path = "/particles/all/mass";
  if (!context.has(path) || !context.has("/particles/all/radius")) return;
  const auto mass = context.root.dataset(path).read<double>();
  const auto radius = context.root.dataset("/particles/all/radius").read<double>();
  constexpr double low = 1, high = 1e5, pi = 3.14159265358979323846;  // kg/m3
  for (std::size_t k = 0; k < mass.size(); ++k) {
    const double density = mass[k] / (4 * pi / 3 * std::pow(1e-9 * radius[k], 3));
    if (!(density >= low && density <= high))
      return context.add(row(path, k), fmt::format("a density from {:g} to {:g} kg/m3", low, high),
                         fmt::format("{:g} kg, that is {:.3g} kg/m3", mass[k], density));
  }
}

// Of arrays of i and j in the particles; what is of no contact is -1 -1, where that may be.
void pairs(const Context& context, const std::string& path, bool may_be_none) {
  if (!context.has(path)) return;
  const auto values = context.root.dataset(path).read<std::int32_t>();
  const auto n = static_cast<std::int64_t>(context.sizes.of("N"));
  for (std::size_t k = 0; k + 1 < values.size(); k += 2) {
    const std::int32_t i = values[k], j = values[k + 1];
    if ((may_be_none && i == -1 && j == -1) || (i >= 0 && i < j && j < n)) continue;
    return context.add(row(path, k / 2), fmt::format("0 <= i < j < {}{}", n, may_be_none ? ", or -1 -1" : ""),
                       fmt::format("{} {}", i, j));
  }
}

void events(const Context& context) {
  in_order(context, "/events/time");
  pairs(context, "/events/pair", true);
  const std::string path = "/events/fragment_offset", sizes_path = "/events/fragment_sizes";
  if (!context.has(path) || !context.has(sizes_path)) return;
  const auto offsets = context.root.dataset(path).read<std::int64_t>();
  const auto sizes = context.root.dataset(sizes_path).read<std::int64_t>();
  for (std::size_t e = 0; e < offsets.size(); ++e)
    if (offsets[e] < (e == 0 ? 0 : offsets[e - 1]) || (e == 0 && offsets[e] != 0) ||
        (e + 1 == offsets.size() && offsets[e] != std::ssize(sizes)))
      return context.add(row(path, e), fmt::format("rows in order from 0 to {}", sizes.size()),
                         std::to_string(offsets[e]));
  const auto n = static_cast<std::int64_t>(context.sizes.of("N"));
  for (std::size_t e = 0; e + 1 < offsets.size(); ++e) {
    std::int64_t sum = 0;
    for (auto k = static_cast<std::size_t>(offsets[e]); k < static_cast<std::size_t>(offsets[e + 1]); ++k) {
      if (k > static_cast<std::size_t>(offsets[e]) && sizes[k] > sizes[k - 1])
        return context.add(row(sizes_path, k), fmt::format("at most the {} before", sizes[k - 1]),
                           std::to_string(sizes[k]));
      // Any number from 1 on may stand here, and the sum of two large ones is none.
      if (sizes[k] > n - sum)
        return context.add(row(sizes_path, k), fmt::format("no more than {} particles together", n),
                           std::to_string(static_cast<std::uint64_t>(sum) + static_cast<std::uint64_t>(sizes[k])));
      sum += sizes[k];
    }
  }
}

void radial_positions_follow(const Context& context) {
  const std::string path = "/morphology/radial_position";
  if (!context.has(path) || !context.has("/particles/all/mass") || !context.has("/particles/all/position")) return;
  const auto frames = context.sizes.of("T");
  const auto flat = context.root.dataset("/particles/all/position/value").read_rows<double>(frames - 1, 1);
  std::vector<Vector3> x(flat.size() / 3);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = {flat[3 * k], flat[3 * k + 1], flat[3 * k + 2]};
  const auto expected = radial_positions(x, context.root.dataset("/particles/all/mass").read<double>());
  const auto found = context.root.dataset(path).read<double>();
  for (std::size_t k = 0; k < found.size(); ++k)
    if (!(std::abs(found[k] - expected[k]) <= 1e-6 * (1 + expected.back())))  // nm
      return context.add(row(path, k), fmt::format("{:.9g}", expected[k]), fmt::format("{:.9g}", found[k]));
}

// A velocity gradient of an incompressible fluid.
void traceless(const Context& context, const std::string& path) {
  if (!context.has(path)) return;
  const auto g = context.root.dataset(path).read<double>();
  double square = 0;
  for (const double x : g) square += x * x;
  const double trace = g[0] + g[4] + g[8];
  if (!(std::abs(trace) <= 1e-6 * std::sqrt(square)))
    context.add(path, "a trace of 0: the fluid is incompressible", fmt::format("{:g}", trace));
}

void basis(const Context& context) {
  const std::string path = "/response/basis";
  if (!context.has(path)) return;
  const auto b = context.root.dataset(path).read<double>();
  for (std::size_t p = 0; p < 5; ++p) {
    const double* m = b.data() + 9 * p;
    double wrong = std::abs(m[0] + m[4] + m[8]) + std::abs(m[1] - m[3]) + std::abs(m[2] - m[6]) + std::abs(m[5] - m[7]);
    for (std::size_t q = 0; q <= p; ++q) {
      double product = 0;
      for (std::size_t k = 0; k < 9; ++k) product += m[k] * b[9 * q + k];
      wrong += std::abs(product - (p == q));
    }
    if (!(wrong <= 1e-9))
      return context.add(row(path, p), "orthonormal symmetric tensors without trace",
                         fmt::format("one that differs by {:.3g}", wrong));
  }
}

}  // namespace

void ranges(const Context& context) {
  for (const std::string& path : context.sound) {
    const schema::Entry* entry = schema::find(path);
    if (!entry) continue;
    const auto range =
        std::find_if(std::begin(allowed), std::end(allowed), [&](const Range& r) { return r.path == entry->path; });
    if (range == std::end(allowed)) continue;
    const bool timed = entry->layout == schema::Layout::frames || entry->layout == schema::Layout::samples;
    const std::string array = timed ? path + "/value" : path;
    if (entry->type == hdf5::Type::float64) within<double>(context, array, *range);
    if (entry->type == hdf5::Type::int64) within<std::int64_t>(context, array, *range);
    if (entry->type == hdf5::Type::int32) within<std::int32_t>(context, array, *range);
  }
  densities(context);
}

void results(const Context& context) {
  events(context);
  pairs(context, "/response/pair", false);
  basis(context);
  traceless(context, "/flow/gradient");
  in_order(context, "/morphology/radial_position");
  radial_positions_follow(context);
  for (const std::string& path : context.sound) {
    if (!path.starts_with("/flows/")) continue;
    if (path.ends_with("/time")) in_order(context, path);
    if (path.ends_with("/gradient")) traceless(context, path);
  }
}

}  // namespace crumble::check
