#include "common/io/agglomerate_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>
#include <type_traits>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/io/checker.hpp"
#include "common/io/output_file.hpp"
#include "common/io/schema.hpp"

namespace crumble {

namespace {

using hdf5::Dataset;
using hdf5::Shape;
using schema::Layout;

const std::string positions = "/particles/all/position";

[[noreturn]] void mistake(const std::string& path, std::string_view what) {
  throw std::logic_error(fmt::format("agglomerate writer: {}: {}", path, what));
}

const schema::Entry& entry_of(const std::string& path, hdf5::Type type) {
  const schema::Entry* entry = schema::find(path);
  if (!entry) mistake(path, "is not in the schema");
  if (entry->type != type) mistake(path, fmt::format("is {} in the schema", hdf5::type_name(entry->type)));
  return *entry;
}

template <class T>
void refuse_non_finite(const std::string& file, const std::string& path, std::span<const T> values) {
  if constexpr (std::is_floating_point_v<T>)
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!std::isfinite(values[k]))
        throw ContentError(fmt::format("{}: {}: value {} is {}; not written", file, path, k, values[k]));
}

void describe(hdf5::Object& object, const schema::Entry& entry, std::string_view unit) {
  if (!unit.empty()) object.set_attribute("unit", unit);
  if (!entry.symbol.empty()) object.set_attribute("symbol", entry.symbol);
  if (!entry.equation.empty()) object.set_attribute("equation", entry.equation);
}

template <class T>
std::vector<T> scaled(std::span<const T> values, double factor) {
  std::vector<T> result(values.begin(), values.end());
  if constexpr (std::is_floating_point_v<T>)
    if (factor != 1)
      for (T& value : result) value *= factor;
  return result;
}

std::span<const double> numbers(const std::vector<Vector3>& vectors) {
  return {vectors.empty() ? nullptr : vectors.front().data(), 3 * vectors.size()};
}

// Rows of a chunk of what grows by contacts or numbers: what a frame has, within 64 rows and half a megabyte, so that
// one frame wastes little space and a thousand frames of a large agglomerate are not a million chunks.
std::uint64_t chunk_rows(std::uint64_t row_bytes, std::uint64_t rows_of_a_frame) {
  return std::clamp<std::uint64_t>(rows_of_a_frame, 64, (1 << 19) / row_bytes);
}

}  // namespace

AgglomerateWriter::AgglomerateWriter(std::filesystem::path path, const Particles& particles,
                                     const FileDescription& description)
    : path_(std::move(path)), removed_(temporary()) {
  if (!schema::stage_named(description.stage)) mistake("stage", description.stage + " is not one");
  if (particles.size() == 0 || particles.mass.size() != particles.size())
    mistake("/particles/all", "needs a radius and a mass for each particle");
  file_ = hdf5::File::create(temporary());
  identity_ = file_identity(temporary());
  try {
    write_head(particles, description);
  } catch (...) {
    file_ = {};
    std::filesystem::remove(temporary());
    throw;
  }
}

AgglomerateWriter::~AgglomerateWriter() {
  if (!open_ || file_.id() < 0) return;
  rows_.clear();
  series_.clear();
  file_ = {};
  std::error_code ignored;
  std::filesystem::remove(temporary(), ignored);
}

void AgglomerateWriter::write_head(const Particles& particles, const FileDescription& description) {
  const auto version = [&](const char* path, int major, int minor) {
    const std::array<std::int32_t, 2> numbers{major, minor};
    file_.create_group(path).set_attribute<std::int32_t>("version", numbers);
  };
  version("/h5md", 1, 1);
  version("/h5md/modules/units", 1, 0);
  version("/h5md/modules/agglomerate", schema::version_major, schema::version_minor);
  file_.create_group("/h5md/author").set_attribute("name", description.provenance.author);
  auto creator = file_.create_group("/h5md/creator");
  creator.set_attribute("name", description.provenance.program);
  creator.set_attribute("version", description.provenance.version);
  file_.group("/h5md/modules/units").set_attribute("system", "SI");
  auto module = file_.group("/h5md/modules/agglomerate");
  module.set_attribute("stage", description.stage);
  const std::array<std::uint8_t, 1> incomplete{0};
  module.set_attribute<std::uint8_t>("complete", incomplete, true);

  auto box = file_.create_group("/particles/all/box");
  const std::array<std::int32_t, 1> three{3};
  box.set_attribute<std::int32_t>("dimension", three, true);
  box.set_text_attribute("boundary", {"none", "none", "none"});
  file_.soft_link("all", "/particles/trajectory");

  const std::uint64_t n = particles.size();
  stage_ = description.stage;
  force_meaning_ = description.force_meaning;
  radius_ = particles.radius;
  mass_ = particles.mass;
  std::vector<std::int64_t> id = particles.id;
  if (id.empty()) {
    id.resize(n);
    std::iota(id.begin(), id.end(), 0);
  }
  const std::vector<std::int32_t> species =
      particles.species.empty() ? std::vector<std::int32_t>(n) : particles.species;
  put<double>("/particles/all/radius", radius_, {n});
  put<double>("/particles/all/mass", mass_, {n});
  put<std::int64_t>("/particles/all/id", id, {n});
  put<std::int32_t>("/particles/all/species", species, {n});
  if (!description.resolved.empty() || !description.input.empty()) {
    file_.write_text("/parameters/input", description.input);
    file_.write_text("/parameters/resolved", description.resolved);
  }
  write_provenance(description.provenance);
}

void AgglomerateWriter::write_provenance(const Provenance& provenance) {
  auto group = file_.create_group("/parameters/provenance");
  group.set_attribute("program", provenance.program);
  group.set_attribute("version", provenance.version);
  group.set_attribute("git", provenance.git);
  const std::array<std::uint8_t, 1> dirty{provenance.dirty};
  group.set_attribute<std::uint8_t>("dirty", dirty, true);
  group.set_attribute("compiler", provenance.compiler);
  group.set_attribute("flags", provenance.flags);
  group.set_attribute("blas", provenance.blas);
  group.set_attribute("command", provenance.command);
  group.set_attribute("created", provenance.created);
  const std::array<std::uint64_t, 1> seed{provenance.seed};
  group.set_attribute<std::uint64_t>("seed", seed, true);
  group.set_attribute("rng", provenance.rng);
  if (provenance.parent.empty()) return;
  // Relative to our own folder, so that both files may move together.
  const auto folder = std::filesystem::absolute(path_).parent_path();
  group.set_attribute("parent", std::filesystem::absolute(provenance.parent).lexically_proximate(folder).string());
  group.set_attribute("parent_sha256", provenance.parent_sha256);
}

template <class T>
void AgglomerateWriter::put(const std::string& path, std::span<const T> values, const Shape& shape,
                            const std::string& method, const std::string& unit) {
  const schema::Entry& entry = entry_of(path, hdf5::type_of<T>());
  if (entry.layout != Layout::dataset) mistake(path, "is not a plain array in the schema");
  const auto words = schema::words(entry.shape);
  if (words.size() != shape.size()) mistake(path, fmt::format("needs shape [{}]", entry.shape));
  if (hdf5::element_count(shape) != values.size()) mistake(path, "number of values does not fit the shape");
  refuse_non_finite(path_.string(), path, values);
  const std::string_view file_unit = entry.unit == "any" ? std::string_view(unit) : entry.unit;
  Dataset dataset = file_.create_dataset<T>(path, shape);
  dataset.template write<T>(scaled(values, schema::file_factor(file_unit)));
  describe(dataset, entry, file_unit);
  if (!method.empty()) dataset.set_attribute("method", method);
}

void AgglomerateWriter::put(const std::string& path, double value, const std::string& method) {
  const schema::Entry* entry = schema::find(path);
  if (entry && entry->type == hdf5::Type::int64) {
    const std::array<std::int64_t, 1> count{std::llround(value)};
    return put<std::int64_t>(path, count, {}, method);
  }
  const std::array<double, 1> values{value};
  put<double>(path, values, {}, method);
}

void AgglomerateWriter::put_attribute(const std::string& path, const std::string& value) {
  const schema::Entry& entry = entry_of(path, hdf5::Type::text);
  if (entry.layout != Layout::attribute) mistake(path, "is not an attribute in the schema");
  const auto at = path.find('@');
  file_.create_group(path.substr(0, at)).set_attribute(path.substr(at + 1), value);
}

// The array that grows by one row a frame, or by one row a contact; made when the first frame comes.
Dataset& AgglomerateWriter::rows(const std::string& path) {
  if (const auto known = rows_.find(path); known != rows_.end()) return known->second;
  if (frames_ > 0) mistake(path, "was not in the first frame");
  const schema::Entry* entry = schema::find(path);
  if (!entry) mistake(path, "is not in the schema");
  const bool timed = entry->layout == Layout::frames;
  std::string place = path;
  if (timed && path != positions) {
    file_.create_group(path);
    file_.hard_link(positions + "/step", path + "/step");
    file_.hard_link(positions + "/time", path + "/time");
  }
  if (timed) place += "/value";
  Shape shape;
  for (const auto word : schema::words(entry->shape))
    shape.push_back(word == "N" ? radius_.size() : shape.empty() ? 0 : std::stoull(std::string(word)));
  std::uint64_t row = 1;
  for (std::size_t d = 1; d < shape.size(); ++d) row *= shape[d];
  const std::uint64_t per_frame = entry->shape.starts_with("M") ? 2 * radius_.size() : 64;
  const bool wide = entry->shape.starts_with("T N");
  const std::uint64_t chunk = wide ? 1 + 1024 / (8 * row) : chunk_rows(8 * row, per_frame);
  auto create = [&]<class T>(T) { return file_.create_dataset<T>(place, shape, chunk); };
  using hdf5::Type;
  Dataset dataset = entry->type == Type::float64 ? create(double{})
                    : entry->type == Type::int64 ? create(std::int64_t{})
                    : entry->type == Type::int32 ? create(std::int32_t{})
                                                 : create(std::uint8_t{});
  describe(dataset, *entry, entry->unit);
  if (path.ends_with("/force") || path.ends_with("/torque")) dataset.set_attribute("meaning", force_meaning_);
  return rows_[path] = std::move(dataset);
}

template <class T>
void AgglomerateWriter::append_frame_rows(const std::string& path, std::span<const T> values) {
  refuse_non_finite(path_.string(), path, values);
  const schema::Entry& entry = entry_of(path, hdf5::type_of<T>());
  Dataset& dataset = rows(path);
  std::uint64_t row = 1;
  const Shape shape = dataset.shape();
  for (std::size_t d = 1; d < shape.size(); ++d) row *= shape[d];
  dataset.append_rows<T>(values.size() / row, scaled(values, schema::file_factor(entry.unit)));
}

void AgglomerateWriter::append_vectors(const std::string& path, const std::vector<Vector3>& vectors) {
  if (vectors.empty() && !rows_.contains(path)) return;
  if (vectors.size() != radius_.size()) mistake(path, fmt::format("has {} particles", vectors.size()));
  append_frame_rows(path, numbers(vectors));
}

void AgglomerateWriter::append_contacts(const std::vector<Contact>& contacts) {
  const auto n = static_cast<std::int32_t>(radius_.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    if (c.i < 0 || c.i >= c.j || c.j >= n) mistake("/contacts/pair", fmt::format("contact {}: {} {}", k, c.i, c.j));
    if (k > 0 && std::pair(contacts[k - 1].i, contacts[k - 1].j) >= std::pair(c.i, c.j))
      mistake("/contacts/pair", fmt::format("contact {} {} is a duplicate or out of order", c.i, c.j));
  }
  const auto column = [&]<class T>(const char* name, T Contact::*member) {
    std::vector<T> values;
    values.reserve(contacts.size());
    for (const Contact& contact : contacts) values.push_back(contact.*member);
    const std::string path = std::string("/contacts/") + name;
    if constexpr (std::is_same_v<T, Vector3>)
      append_frame_rows(path, numbers(values));
    else
      append_frame_rows<T>(path, values);
  };
  last_pairs_.clear();
  for (const Contact& contact : contacts) last_pairs_.insert(last_pairs_.end(), {contact.i, contact.j});
  append_frame_rows<std::int32_t>("/contacts/pair", last_pairs_);
  column("normal", &Contact::normal);
  column("gap", &Contact::gap);
  column("sliding", &Contact::sliding);
  column("rolling", &Contact::rolling);
  column("twisting", &Contact::twisting);
  column("normal_force", &Contact::normal_force);
  column("sliding_force", &Contact::sliding_force);
  column("twisting_torque", &Contact::twisting_torque);
  column("rolling_torque", &Contact::rolling_torque);
  column("flags", &Contact::at_limit);
  column("born", &Contact::born);
  contacts_ += contacts.size();
  std::vector<std::int64_t> offsets;
  if (frames_ == 0) offsets.push_back(0);
  offsets.push_back(static_cast<std::int64_t>(contacts_));
  append_frame_rows<std::int64_t>("/contacts/offset", offsets);
}

void AgglomerateWriter::append_observables(const Frame& frame, const Observables& observables) {
  const auto value = [&](const std::string& name, double number) {
    const std::string path = "/observables/" + name;
    const schema::Entry* entry = schema::find(path);
    if (!entry) mistake(path, "is not in the schema");
    const std::array<double, 1> real{number};
    const std::array<std::int64_t, 1> whole{std::isfinite(number) ? std::llround(number) : 0};
    if (entry->type == hdf5::Type::int64)
      append_frame_rows<std::int64_t>(path, whole);
    else
      append_frame_rows<double>(path, real);
  };
  const auto labels = fragments(radius_.size(), frame.contacts);
  const auto sizes = fragment_sizes(labels);
  if (stage_ == "breaker") append_frame_rows<std::int32_t>("/particles/all/fragment", labels);
  value("radius_of_gyration", radius_of_gyration(frame.position, mass_));
  append_frame_rows<double>("/observables/semi_axes", semi_axes(frame.position, radius_, mass_));
  value("contact_count", static_cast<double>(frame.contacts.size()));
  value("coordination_number", coordination_number(radius_.size(), frame.contacts.size()));
  value("fragment_count", static_cast<double>(sizes.size()));
  value("largest_fragment", static_cast<double>(sizes.empty() ? 0 : sizes.front()));
  for (const auto& [name, number] : observables) value(name, number);
  for (const schema::Entry& entry : schema::table())
    if (entry.layout == Layout::frames && (entry.required & *schema::stage_named(stage_)) &&
        !rows_.contains(std::string(entry.path)))
      mistake(std::string(entry.path), "is required of " + stage_);
}

void AgglomerateWriter::append(const Frame& frame, const Observables& observables) {
  if (!open_) mistake("append", "the file is closed");
  if (frames_ > 0 && (frame.step <= last_step_ || !(frame.time > last_time_)))
    mistake(positions, fmt::format("step {} at {} s does not follow step {} at {} s", frame.step, frame.time,
                                   last_step_, last_time_));
  const std::array<std::int64_t, 1> step{frame.step};
  const std::array<double, 1> time{frame.time};
  refuse_non_finite<double>(path_.string(), positions + "/time", time);
  if (frames_ == 0) {
    rows_[positions + "/step"] = file_.create_dataset<std::int64_t>(positions + "/step", {0}, 64);
    auto& times = rows_[positions + "/time"] = file_.create_dataset<double>(positions + "/time", {0}, 64);
    times.set_attribute("unit", "s");
  }
  rows_.at(positions + "/step").append_rows<std::int64_t>(1, step);
  rows_.at(positions + "/time").append_rows<double>(1, time);
  append_vectors(positions, frame.position);
  append_vectors("/particles/all/velocity", frame.velocity);
  append_vectors("/particles/all/angular_velocity", frame.angular_velocity);
  append_vectors("/particles/all/force", frame.force);
  append_vectors("/particles/all/torque", frame.torque);
  if (!frame.orientation.empty() || rows_.contains("/particles/all/orientation")) {
    if (frame.orientation.size() != radius_.size()) mistake("/particles/all/orientation", "wrong number of particles");
    std::vector<double> quaternions;
    for (const Quaternion& q : frame.orientation) quaternions.insert(quaternions.end(), {q.w(), q.x(), q.y(), q.z()});
    append_frame_rows<double>("/particles/all/orientation", quaternions);
  }
  append_contacts(frame.contacts);
  append_observables(frame, observables);
  ++frames_;
  last_step_ = frame.step;
  last_time_ = frame.time;
  for (const auto& [path, dataset] : rows_) {
    const schema::Entry* entry = schema::find(path);
    if (entry && entry->layout == Layout::frames && dataset.shape()[0] != frames_)
      mistake(path, "is missing in a frame");
  }
}

void AgglomerateWriter::sample(const std::string& name, const std::string& unit, std::int64_t step, double time,
                               double value) {
  if (!open_) mistake("sample", "the file is closed");
  const std::string path = "/series/" + name;
  auto [place, is_new] = series_.try_emplace(name);
  Series& series = place->second;
  if (is_new) {
    if (name.empty() || name.find_first_of("/@. ") != name.npos) mistake(path, "is not a name");
    series.step = file_.create_dataset<std::int64_t>(path + "/step", {0}, 1024);
    series.time = file_.create_dataset<double>(path + "/time", {0}, 1024);
    series.value = file_.create_dataset<double>(path + "/value", {0}, 1024);
    series.time.set_attribute("unit", "s");
    if (!unit.empty()) series.value.set_attribute("unit", unit);
    series.factor = schema::file_factor(unit);
  }
  const std::array<double, 2> number{time, value};
  refuse_non_finite<double>(path_.string(), path, number);
  if (series.last_step && (step <= *series.last_step || time <= series.last_time))
    mistake(path, fmt::format("step {} at {} s does not follow step {} at {} s", step, time, *series.last_step,
                              series.last_time));
  series.last_step = step;
  series.last_time = time;
  series.steps.push_back(step);
  series.times.push_back(time);
  series.values.push_back(value * series.factor);
  if (series.values.size() >= 1024) write_pending(series);
}

void AgglomerateWriter::write_pending(Series& series) {
  series.step.append_rows<std::int64_t>(series.steps.size(), series.steps);
  series.time.append_rows<double>(series.times.size(), series.times);
  series.value.append_rows<double>(series.values.size(), series.values);
  series.steps.clear();
  series.times.clear();
  series.values.clear();
}

void AgglomerateWriter::close() {
  open_ = false;
  rows_.clear();
  series_.clear();
  file_.close();
}

void AgglomerateWriter::finish(const std::string& state) {
  if (!open_ || frames_ == 0) mistake("finish", "needs an open file with a frame");
  auto pairs = file_.create_dataset<std::int32_t>("/connectivity/contacts", {last_pairs_.size() / 2, 2});
  pairs.write<std::int32_t>(last_pairs_);
  pairs.set_reference_attribute("particles_group", "/particles/all");
  auto module = file_.group("/h5md/modules/agglomerate");
  module.set_attribute("state", state);
  for (auto& [name, series] : series_) write_pending(series);
  file_.flush();  // everything is on disk before the file says so
  const std::array<std::uint8_t, 1> complete{1};
  module.set_attribute<std::uint8_t>("complete", complete, true);
  module = {};
  pairs = {};
  close();
  require_complete();
  publish(temporary(), path_);
}

// The file that gets the name is the one that was written, and it can be read.
void AgglomerateWriter::require_complete() const {
  const auto refuse = [&](const std::string& what) {
    throw WriteError(fmt::format("{}: is not given its name: {}", path_.string(), what));
  };
  if (identity_ != file_identity(temporary())) refuse(temporary().string() + " is not the file that was written");
  for (const Violation& violation : check_file(temporary()))
    if (violation.path != "/parameters/provenance@parent_sha256")  // an input that changed since is not our mistake
      refuse(fmt::format("what is in {} is not valid: {}", temporary().string(), violation.text()));
}

template void AgglomerateWriter::put<std::int32_t>(const std::string&, std::span<const std::int32_t>, const Shape&,
                                                   const std::string&, const std::string&);
template void AgglomerateWriter::put<std::int64_t>(const std::string&, std::span<const std::int64_t>, const Shape&,
                                                   const std::string&, const std::string&);
template void AgglomerateWriter::put<double>(const std::string&, std::span<const double>, const Shape&,
                                             const std::string&, const std::string&);

}  // namespace crumble
