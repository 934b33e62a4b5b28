#include <fmt/format.h>

#include <algorithm>

#include "common/io/agglomerate_writer.hpp"
#include "common/io/schema.hpp"

namespace crumble {

namespace {

const std::string positions = "/particles/all/position";

}  // namespace

AgglomerateWriter AgglomerateWriter::resume(std::filesystem::path path, std::int64_t last_step) {
  const auto temporary = path.string() + ".tmp";
  AgglomerateWriter writer(std::move(path), hdf5::File::modify(temporary));
  try {
    writer.truncate(last_step);
  } catch (...) {
    writer.open_ = false;  // it is not ours to remove
    throw;
  }
  return writer;
}

// Takes up the arrays of a suspended file and cuts them behind the last frame and sample up to the step.
void AgglomerateWriter::truncate(std::int64_t last_step) {
  stage_ = file_.group("/h5md/modules/agglomerate").text_attribute("stage").at(0);
  radius_ = file_.dataset("/particles/all/radius").read<double>();
  for (double& radius : radius_) radius /= schema::file_factor("nm");
  mass_ = file_.dataset("/particles/all/mass").read<double>();
  const auto kept = [&](const std::vector<std::int64_t>& steps) {
    return static_cast<std::uint64_t>(std::upper_bound(steps.begin(), steps.end(), last_step) - steps.begin());
  };
  if (file_.kind("/series") == hdf5::Kind::group)
    for (const auto& name : file_.group("/series").names()) {
      Series& series = series_[name];
      const std::string path = "/series/" + name;
      series.step = file_.dataset(path + "/step");
      series.time = file_.dataset(path + "/time");
      series.value = file_.dataset(path + "/value");
      const auto steps_of_series = series.step.read<std::int64_t>();
      const auto count = kept(steps_of_series);
      if (count > 0) {
        series.last_step = steps_of_series[count - 1];
        series.last_time = series.time.read_rows<double>(count - 1, 1).front();
      }
      for (hdf5::Dataset* dataset : {&series.step, &series.time, &series.value}) dataset->resize_rows(count);
      const auto unit = series.value.has_attribute("unit") ? series.value.text_attribute("unit").at(0) : "";
      series.factor = schema::file_factor(unit);
    }
  if (file_.kind(positions + "/step") == hdf5::Kind::missing) return;
  const auto steps = file_.dataset(positions + "/step").read<std::int64_t>();
  frames_ = kept(steps);
  if (frames_ == 0) throw ContentError(fmt::format("{}: no frame up to step {}", temporary().string(), last_step));
  const auto offsets = file_.dataset("/contacts/offset").read<std::int64_t>();
  contacts_ = static_cast<std::uint64_t>(offsets.at(frames_));
  last_step_ = steps[frames_ - 1];
  last_time_ = file_.dataset(positions + "/time").read<double>().at(frames_ - 1);
  for (const char* end : {"/step", "/time"})
    (rows_[positions + end] = file_.dataset(positions + end)).resize_rows(frames_);
  for (const schema::Entry& entry : schema::table()) {
    const std::string path(entry.path), place = entry.layout == schema::Layout::frames ? path + "/value" : path;
    const std::string_view rows = entry.shape.substr(0, entry.shape.find(' '));
    if (path.find('<') != path.npos || (rows != "T" && rows != "T+1" && rows != "M")) continue;
    if (file_.kind(place) != hdf5::Kind::dataset) continue;
    (rows_[path] = file_.dataset(place)).resize_rows(rows == "T" ? frames_ : rows == "M" ? contacts_ : frames_ + 1);
  }
  const auto first = static_cast<std::uint64_t>(offsets.at(frames_ - 1));
  last_pairs_ = file_.dataset("/contacts/pair").read_rows<std::int32_t>(first, contacts_ - first);
  if (file_.kind("/particles/all/force/value") == hdf5::Kind::dataset)
    force_meaning_ = file_.dataset("/particles/all/force/value").text_attribute("meaning").at(0);
}

}  // namespace crumble
