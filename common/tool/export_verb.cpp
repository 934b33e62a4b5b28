#include <fmt/format.h>

#include <filesystem>
#include <ostream>

#include "common/agglomerate/extended_xyz.hpp"
#include "common/io/agglomerate_reader.hpp"
#include "common/io/output_lock.hpp"
#include "common/tool/frames.hpp"
#include "common/tool/verbs.hpp"
#include "common/tool/vtkhdf.hpp"

namespace crumble::tool {
namespace {

namespace fs = std::filesystem;

// What is written beside OUT, under a name that comes from it.
void require_ours(const std::string& name, const std::string& input) {
  require_separate({{.what = "agglomerate: -o", .name = name, .is_text = !name.ends_with(".hdf")}},
                   {{"the input", input}});
}

void export_xyz(const AgglomerateReader& reader, const std::vector<std::size_t>& numbers, const std::string& output,
                const std::string& input, std::ostream& out) {
  const std::string bonds_name = fs::path(output).replace_extension(".bonds.dump").string();
  require_ours(bonds_name, input);
  TextFile particles(output), bonds(bonds_name);
  for (std::size_t number : numbers) {
    const Frame frame = reader.frame(number);
    write_extended_xyz(particles.stream(), reader.particles(), frame);
    write_bonds(bonds.stream(), reader.particles(), frame);
  }
  bonds.finish();
  particles.finish();
  out << fmt::format("{}: {} frame(s), {} particles; bonds in {}\n", output, numbers.size(), reader.particles().size(),
                     bonds_name);
}

// One file for one frame; else OUT/0000.hdf, OUT/0001.hdf, ... and beside that folder OUT.hdf.series, which holds them
// together.
void export_hdf(const AgglomerateReader& reader, const std::vector<std::size_t>& numbers, const std::string& output,
                const std::string& input, std::ostream& out) {
  if (numbers.size() == 1) {
    write_vtkhdf(output, reader.particles(), reader.frame(numbers.front()));
    out << fmt::format("{}: 1 frame, {} particles\n", output, reader.particles().size());
    return;
  }
  const std::string series_name = output + ".series";
  require_ours(series_name, input);
  const fs::path folder = fs::path(output).replace_extension();
  std::error_code failed;
  fs::create_directory(folder, failed);
  if (failed || !fs::is_directory(folder))
    throw InputError("agglomerate: -o " + output + ": the frames go into the folder '" + folder.string() +
                     "', which cannot be made" + (failed ? ": " + failed.message() : ""));
  std::vector<std::pair<std::string, double>> members;
  for (std::size_t number : numbers) {
    const std::string name = (folder / fmt::format("{:04}.hdf", number)).string();
    require_ours(name, input);
    const Frame frame = reader.frame(number);
    write_vtkhdf(name, reader.particles(), frame);
    members.emplace_back((folder.filename() / fs::path(name).filename()).string(), frame.time);
  }
  TextFile series(series_name);
  series.stream() << series_text(members);
  series.finish();
  out << fmt::format("{}.series: {} frames, {} to {}\n", output, numbers.size(), members.front().first,
                     members.back().first);
}

}  // namespace

int export_frames(const ExportOptions& options, std::ostream& out) {
  const std::string ending = fs::path(options.output).extension().string();
  if (ending != ".xyz" && ending != ".hdf") {
    throw InputError("agglomerate: -o " + options.output +
                     ": must end with .xyz (extended XYZ for OVITO) or .hdf (VTKHDF for ParaView)");
  }
  const bool is_text = ending == ".xyz";
  const OwnedOutputs owned({{.what = "agglomerate: -o", .name = options.output, .is_text = is_text}},
                           {{"the input", options.input}});
  const AgglomerateReader reader(options.input);
  const auto numbers = chosen_frames(options.frame, reader.frame_count(), options.input);
  if (is_text) {
    export_xyz(reader, numbers, options.output, options.input, out);
  } else {
    export_hdf(reader, numbers, options.output, options.input, out);
  }
  return 0;
}

}  // namespace crumble::tool
