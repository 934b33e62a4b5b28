#include "common/flow/tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "common/io/errors.hpp"
#include "common/io/hdf5.hpp"

namespace crumble {

namespace {

bool is_hdf5(const std::filesystem::path& name) { return name.extension() == ".h5" || name.extension() == ".hdf5"; }

void require_unit(const hdf5::Dataset& data, const std::string& where, const std::vector<std::string>& units) {
  const std::string unit = data.has_attribute("unit") ? data.text_attribute("unit").at(0) : "";
  if (std::find(units.begin(), units.end(), unit) == units.end())
    throw InputError(fmt::format("{}: attribute unit = '{}': must say '{}'", where, unit, units.front()));
}

Tracks in_hdf5(const std::string& name, double largest_step) {
  struct Open {
    hdf5::File file;
    hdf5::Dataset gradient;
    std::vector<double> time;
  };
  const auto open = std::make_shared<Open>();
  open->file = hdf5::File::open(name);
  for (const char* path : {"/time", "/gradient"})
    if (open->file.kind(path) != hdf5::Kind::dataset)
      throw InputError(fmt::format("{}: has no dataset {}: tracks are /time and /gradient", name, path));
  const hdf5::Dataset time = open->file.dataset("/time");
  open->gradient = open->file.dataset("/gradient");
  require_unit(time, name + ":/time", {"s"});
  require_unit(open->gradient, name + ":/gradient", {"s-1", "1/s"});
  const hdf5::Shape shape = open->gradient.shape(), instants = time.shape();
  if (instants.size() != 1 || shape.size() != 4 || shape[1] != instants[0] || shape[2] != 3 || shape[3] != 3 ||
      shape[0] == 0)
    throw InputError(fmt::format("{}: /gradient {} and /time {}: expected tracks x instants x 3 x 3 and instants", name,
                                 hdf5::shape_text(shape), hdf5::shape_text(instants)));
  if (!time.is_stored() || !open->gradient.is_stored())
    throw InputError(name + ": /time or /gradient is declared but not stored");
  open->time = time.read<double>();
  return {static_cast<std::size_t>(shape[0]), [open, name, largest_step](std::size_t k) {
            const std::vector<double> values = open->gradient.read_rows<double>(k, 1);
            std::vector<Eigen::Matrix3d> gradient;
            for (std::size_t i = 0; i < open->time.size(); ++i)
              gradient.push_back(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&values[9 * i]));
            return GradientHistory::of(open->time, std::move(gradient), name, largest_step, [&](std::size_t i) {
              return fmt::format("{}: track {}, instant {}", name, k + 1, i + 1);
            });
          }};
}

}  // namespace

bool is_many_tracks(const std::string& name) { return std::filesystem::is_directory(name) || is_hdf5(name); }

std::vector<std::string> track_files(const std::string& name) {
  if (is_hdf5(name)) return {name};
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(name))
    if (entry.path().extension() == ".csv") files.push_back(entry.path().string());
  if (files.empty()) throw InputError(name + ": a folder without .csv files, so without histories");
  std::sort(files.begin(), files.end());
  return files;
}

Tracks read_tracks(const std::string& name, double largest_step) {
  if (is_hdf5(name)) return in_hdf5(name, largest_step);
  const std::vector<std::string> files = track_files(name);
  return {files.size(), [files, largest_step](std::size_t k) { return GradientHistory::read(files[k], largest_step); }};
}

}  // namespace crumble
