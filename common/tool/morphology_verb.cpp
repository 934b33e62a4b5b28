#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>

#include "common/agglomerate/morphology.hpp"
#include "common/io/agglomerate_reader.hpp"
#include "common/tool/frames.hpp"
#include "common/tool/verbs.hpp"

namespace crumble::tool {
namespace {

// Everything that is printed, once: its name for programs, what it is, and where it stands.
struct Quantity {
  const char *name, *meaning;
  std::function<double(const Morphology&)> value;
  bool is_count = false;
};

const std::vector<Quantity>& quantities() {
  constexpr double nm = 1e9;
  using M = Morphology;
  static const std::vector<Quantity> all{
      {"d_c_nm", "diameter, nm", [](const M& m) { return nm * m.extent.diameter(); }},
      {"h_c_nm", "crust thickness, nm", [](const M& m) { return nm * m.extent.crust_thickness(); }},
      {"h_c_over_d_c", "crust thickness over diameter (0.5: compact)",
       [](const M& m) { return m.extent.relative_crust(); }},
      {"radius_of_gyration_nm", "radius of gyration, nm", [](const M& m) { return nm * m.radius_of_gyration; }},
      {"semi_axis_1_nm", "semi-axes of the ellipsoid of equal inertia, nm",
       [](const M& m) { return nm * m.semi_axes[0]; }},
      {"semi_axis_2_nm", "", [](const M& m) { return nm * m.semi_axes[1]; }},
      {"semi_axis_3_nm", "", [](const M& m) { return nm * m.semi_axes[2]; }},
      {"porosity", "void fraction within the diameter", [](const M& m) { return m.porosity; }},
      {"contacts", "bonded pairs", [](const M& m) { return static_cast<double>(m.contacts); }, true},
      {"coordination", "contacts of a particle, mean", [](const M& m) { return m.coordination; }},
      {"touching", "pairs with a gap below 0.02 radii", [](const M& m) { return static_cast<double>(m.touching); },
       true},
      {"coordination_touching", "such neighbours of a particle, mean",
       [](const M& m) { return m.coordination_touching; }},
      {"fragments", "pieces that no contact connects", [](const M& m) { return static_cast<double>(m.fragments); },
       true},
      {"largest_fragment", "particles in the largest",
       [](const M& m) { return static_cast<double>(m.largest_fragment); }, true},
  };
  return all;
}

void as_table(std::ostream& out, const Frame& frame, const Morphology& m) {
  out << fmt::format("step {}, {:.6g} s, {} particles\n", frame.step, frame.time, m.particles);
  for (const Quantity& q : quantities()) out << fmt::format("  {:<24}{:<12.6g}{}\n", q.name, q.value(m), q.meaning);
}

nlohmann::ordered_json as_json(const Particles& particles, const Frame& frame, const Morphology& m) {
  nlohmann::ordered_json json{{"step", frame.step}, {"time_s", frame.time}, {"particles", m.particles}};
  for (const Quantity& q : quantities()) {
    const double value = q.value(m);
    if (q.is_count) {
      json[q.name] = static_cast<std::int64_t>(value);
    } else {
      json[q.name] = value;
    }
  }
  std::vector<double> r = radial_positions(frame.position, particles.mass);
  for (double& value : r) value *= 1e9;
  json["radial_positions_nm"] = r;
  return json;
}

void distribution(std::ostream& out, const Particles& particles, const Frame& frame) {
  out << "radial_position_nm,fraction\n";
  const std::vector<double> r = radial_positions(frame.position, particles.mass);
  for (std::size_t k = 0; k < r.size(); ++k) {
    out << fmt::format("{},{}\n", 1e9 * r[k], static_cast<double>(k + 1) / static_cast<double>(r.size()));
  }
}

}  // namespace

int morphology(const MorphologyOptions& options, std::ostream& out) {
  const AgglomerateReader reader(options.file);
  const auto numbers = chosen_frames(options.frame, reader.frame_count(), options.file);
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  if (options.format == Format::csv) {
    out << "step,time_s,particles";
    for (const Quantity& q : quantities()) out << "," << q.name;
    out << "\n";
  }
  for (std::size_t number : numbers) {
    const Frame frame = reader.frame(number);
    if (options.format == Format::cdf) {
      distribution(out, reader.particles(), frame);
      continue;
    }
    const Morphology m = crumble::morphology(reader.particles(), frame);
    if (options.format == Format::json) {
      frames.push_back(as_json(reader.particles(), frame, m));
    } else if (options.format == Format::csv) {
      out << fmt::format("{},{},{}", frame.step, frame.time, m.particles);
      for (const Quantity& q : quantities()) out << fmt::format(",{}", q.value(m));
      out << "\n";
    } else {
      as_table(out, frame, m);
    }
  }
  if (options.format == Format::json) {
    out << nlohmann::ordered_json{{"file", options.file}, {"frames", frames}}.dump(2) << "\n";
  }
  return 0;
}

}  // namespace crumble::tool
