#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "common/agglomerate/morphology.hpp"
#include "common/io/agglomerate_reader.hpp"
#include "common/tool/verbs.hpp"

namespace crumble::tool {
namespace {

struct Radii {
  double smallest, mean, largest;  // nm
};

Radii radii_of(const Particles& particles) {
  const std::vector<double>& a = particles.radius;
  const auto [low, high] = std::minmax_element(a.begin(), a.end());
  return {1e9 * *low, 1e9 * mean_radius(particles), 1e9 * *high};
}

nlohmann::ordered_json as_json(const std::string& file, const FileInfo& info, const Radii& radii) {
  const Provenance& p = info.provenance;
  nlohmann::ordered_json from{
      {"program", p.program},   {"version", p.version}, {"git", p.git},   {"dirty", p.dirty},
      {"compiler", p.compiler}, {"flags", p.flags},     {"blas", p.blas}, {"command", p.command},
      {"created", p.created},   {"seed", p.seed},       {"rng", p.rng}};
  if (!p.parent.empty()) {
    from["parent"] = p.parent;
    from["parent_sha256"] = p.parent_sha256;
  }
  return {{"file", file},
          {"schema", fmt::format("{}.{}", info.version_major, info.version_minor)},
          {"stage", info.stage},
          {"state", info.state},
          {"particles", info.particles},
          {"radius_nm", {{"smallest", radii.smallest}, {"mean", radii.mean}, {"largest", radii.largest}}},
          {"contacts", info.contacts},
          {"frames", info.frames},
          {"first_step", info.first_step},
          {"last_step", info.last_step},
          {"first_time_s", info.first_time},
          {"last_time_s", info.last_time},
          {"bytes", info.bytes},
          {"made_of", info.properties},
          {"provenance", from}};
}

void as_text(std::ostream& out, const std::string& file, const FileInfo& info, const Radii& radii) {
  const Provenance& p = info.provenance;
  const auto line = [&](const char* name, const std::string& value) {
    if (!value.empty()) out << fmt::format("  {:<11}{}\n", name, value);
  };
  out << file << "\n";
  line("stage", info.stage + ", " + info.state);
  line("particles", fmt::format("{}, radius {:.6g} nm", info.particles, radii.mean) +
                        (radii.largest > radii.smallest
                             ? fmt::format(" in the mean ({:.6g} to {:.6g})", radii.smallest, radii.largest)
                             : ""));
  line("contacts", fmt::format("{} in the last frame", info.contacts));
  line("frames", info.frames == 1 ? fmt::format("1, step {} at {:.6g} s", info.last_step, info.last_time)
                                  : fmt::format("{}, steps {} to {}, {:.6g} to {:.6g} s", info.frames, info.first_step,
                                                info.last_step, info.first_time, info.last_time));
  std::string made_of;
  for (const auto& [key, value] : info.properties)
    made_of += fmt::format("{}{} = {:g}", made_of.empty() ? "" : ", ", key, value);
  line("made of", made_of);
  line("format", fmt::format("{}.{}, {} bytes", info.version_major, info.version_minor, info.bytes));
  line("made by", fmt::format("{} {}, commit {}{}", p.program, p.version, p.git, p.dirty ? " with changes" : ""));
  line("built with", p.compiler + " " + p.flags);
  line("BLAS", p.blas);
  line("command", p.command);
  line("created", p.created);
  if (p.rng != "none") line("seed", fmt::format("{}, {}", p.seed, p.rng));
  line("parent", p.parent.empty() ? "" : p.parent + " (sha256 " + p.parent_sha256 + ")");
}

}  // namespace

int info(const InfoOptions& options, std::ostream& out) {
  const AgglomerateReader reader(options.file);
  const Radii radii = radii_of(reader.particles());
  if (options.format == Format::json) {
    out << as_json(options.file, reader.info(), radii).dump(2) << "\n";
  } else {
    as_text(out, options.file, reader.info(), radii);
  }
  return 0;
}

}  // namespace crumble::tool
