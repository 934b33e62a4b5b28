#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include "common/agglomerate/morphology.hpp"
#include "common/io/agglomerate_reader.hpp"
#include "common/tool/frames.hpp"
#include "common/tool/quantities.hpp"
#include "common/tool/verbs.hpp"

namespace crumble::tool {
namespace {

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
