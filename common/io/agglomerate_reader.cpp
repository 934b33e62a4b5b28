#include "common/io/agglomerate_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/io/checker.hpp"
#include "common/io/in_child.hpp"

namespace crumble {

namespace {

using hdf5::Kind;
using schema::Layout;

const std::string positions = "/particles/all/position";
const std::string module_path = "/h5md/modules/agglomerate";

Provenance read_provenance(const hdf5::Group& root) {
  Provenance provenance;
  const auto author = root.group("/h5md/author");
  const auto group = root.group("/parameters/provenance");
  const auto text = [&](const char* name) {
    const auto texts = group.has_attribute(name) ? group.text_attribute(name) : std::vector<std::string>{};
    return texts.empty() ? std::string() : texts[0];
  };
  provenance.author = author.has_attribute("name") ? author.text_attribute("name").at(0) : "";
  provenance.program = text("program");
  provenance.version = text("version");
  provenance.git = text("git");
  provenance.dirty = group.attribute<std::uint8_t>("dirty").at(0) != 0;
  provenance.compiler = text("compiler");
  provenance.flags = text("flags");
  provenance.blas = text("blas");
  provenance.command = text("command");
  provenance.created = text("created");
  provenance.seed = group.attribute<std::uint64_t>("seed").at(0);
  provenance.rng = text("rng");
  provenance.parent = text("parent");
  provenance.parent_sha256 = text("parent_sha256");
  return provenance;
}

Vector3 vector_at(const std::vector<double>& values, std::size_t row) {
  return {values[3 * row], values[3 * row + 1], values[3 * row + 2]};
}

}  // namespace

void AgglomerateReader::refuse(const Violation& violation) const {
  throw ContentError(name_ + ": " + violation.text());
}

// A dataset whose form has been compared with the schema, so that its numbers can be used without further question.
const hdf5::Dataset& AgglomerateReader::checked(const std::string& path) const {
  if (const auto known = checked_.find(path); known != checked_.end()) return known->second;
  const schema::Entry* entry = schema::find(path);
  if (!entry) throw ContentError(name_ + ": " + path + ": is not in the schema");
  const auto violations = schema::check_form(file_, *entry, path, sizes_);
  if (!violations.empty()) refuse(violations.front());
  const bool timed = entry->layout == Layout::frames || entry->layout == Layout::samples;
  return checked_[path] = file_.dataset(timed ? path + "/value" : path);
}

// Whether the frames have a field that not every stage knows.
bool AgglomerateReader::has(const std::string& path) const {
  return checked_.contains(path) || file_.kind(path) != Kind::missing;
}

AgglomerateReader::AgglomerateReader(const std::filesystem::path& path)
    : AgglomerateReader((in_child(path,
                                  [&] {
                                    const AgglomerateReader reader(path, Unprotected{});
                                    require_valid(path);
                                    return std::string();
                                  }),
                         path),
                        Unprotected{}) {}

AgglomerateReader::AgglomerateReader(const std::filesystem::path& path, Unprotected)
    : name_(path.string()), file_(hdf5::File::open(path)) {
  for (const char* attribute : {"@version", "@stage", "@state", "@complete"}) {
    const std::string place = module_path + attribute;
    if (place.ends_with("@state") && file_.group(module_path).attribute<std::uint8_t>("complete").at(0) == 0)
      throw ContentError(name_ + ": is incomplete: the program that wrote it did not finish");
    const auto violations = schema::check_form(file_, *schema::find(place), place, sizes_);
    if (!violations.empty()) refuse(violations.front());
    if (!place.ends_with("@version")) continue;
    const auto version = file_.group(module_path).attribute<std::int32_t>("version");
    info_.version_major = version[0];
    info_.version_minor = version[1];
    if (version[0] != schema::version_major || version[1] > schema::version_minor)
      throw ContentError(fmt::format("{}: has schema version {}.{}; this program reads {}.0 to {}.{}", name_,
                                     version[0], version[1], schema::version_major, schema::version_major,
                                     schema::version_minor));
  }
  const auto module = file_.group(module_path);
  info_.stage = module.text_attribute("stage").at(0);
  info_.state = module.text_attribute("state").at(0);
  for (const schema::Entry& entry : schema::table())
    if (entry.path.starts_with("/parameters/provenance@") && entry.required)
      if (const auto wrong = schema::check_form(file_, entry, std::string(entry.path), sizes_); !wrong.empty())
        refuse(wrong.front());
  info_.provenance = read_provenance(file_);
  for (const TravellingKey& k : travelling_keys())
    if (has(std::string(k.path))) checked(std::string(k.path));
  info_.properties = read_properties(file_);

  checked(positions);
  steps_ = file_.dataset(positions + "/step").read<std::int64_t>();
  times_ = file_.dataset(positions + "/time").read<double>();
  offsets_ = checked("/contacts/offset").read<std::int64_t>();
  checked("/contacts/pair");
  const auto rows = static_cast<std::int64_t>(sizes_.of("M"));
  if (steps_.empty()) refuse({positions, "a frame", "none"});
  if (offsets_.front() != 0 || offsets_.back() != rows || !std::is_sorted(offsets_.begin(), offsets_.end()))
    refuse({"/contacts/offset", fmt::format("rows in order from 0 to {}", rows), "others"});
  info_.particles = sizes_.of("N");
  info_.frames = steps_.size();
  info_.contacts = static_cast<std::uint64_t>(rows - offsets_[steps_.size() - 1]);
  info_.first_step = steps_.front();
  info_.last_step = steps_.back();
  info_.first_time = times_.front();
  info_.last_time = times_.back();
  info_.bytes = std::filesystem::file_size(path);

  particles_.radius = real_rows("/particles/all/radius", 0, info_.particles);
  particles_.mass = real_rows("/particles/all/mass", 0, info_.particles);
  particles_.id = checked("/particles/all/id").read<std::int64_t>();
  particles_.species = checked("/particles/all/species").read<std::int32_t>();
}

std::vector<double> AgglomerateReader::real_rows(const std::string& path, std::uint64_t first,
                                                 std::uint64_t count) const {
  auto values = checked(path).read_rows<double>(first, count);
  const double factor = schema::file_factor(schema::find(path)->unit);
  if (factor != 1)
    for (double& value : values) value /= factor;
  return values;
}

std::vector<Vector3> AgglomerateReader::vectors(const std::string& path, std::uint64_t first,
                                                std::uint64_t count) const {
  const auto values = real_rows(path, first, count);
  std::vector<Vector3> result(values.size() / 3);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = vector_at(values, k);
  return result;
}

std::vector<Contact> AgglomerateReader::contacts(std::uint64_t first, std::uint64_t count) const {
  std::vector<Contact> list(count);
  const auto n = static_cast<std::int32_t>(info_.particles);
  const auto pairs = checked("/contacts/pair").read_rows<std::int32_t>(first, count);
  for (std::size_t k = 0; k < count; ++k) {
    list[k].i = pairs[2 * k];
    list[k].j = pairs[2 * k + 1];
    if (list[k].i < 0 || list[k].i >= list[k].j || list[k].j >= n)
      refuse({"/contacts/pair", fmt::format("0 <= i < j < {} in row {}", n, first + k),
              fmt::format("{} {}", list[k].i, list[k].j)});
  }
  const auto column = [&](const std::string& name, double Contact::*member) {
    const auto values = real_rows("/contacts/" + name, first, count);
    for (std::size_t k = 0; k < count; ++k) list[k].*member = values[k];
  };
  const auto vector_column = [&](const std::string& name, Vector3 Contact::*member) {
    const auto values = real_rows("/contacts/" + name, first, count);
    for (std::size_t k = 0; k < count; ++k) list[k].*member = vector_at(values, k);
  };
  vector_column("normal", &Contact::normal);
  column("gap", &Contact::gap);
  vector_column("sliding", &Contact::sliding);
  vector_column("rolling", &Contact::rolling);
  column("twisting", &Contact::twisting);
  column("normal_force", &Contact::normal_force);
  vector_column("sliding_force", &Contact::sliding_force);
  column("twisting_torque", &Contact::twisting_torque);
  vector_column("rolling_torque", &Contact::rolling_torque);
  const auto flags = checked("/contacts/flags").read_rows<std::uint8_t>(first, count);
  const auto born = checked("/contacts/born").read_rows<std::int64_t>(first, count);
  for (std::size_t k = 0; k < count; ++k) {
    list[k].at_limit = flags[k];
    list[k].born = born[k];
  }
  return list;
}

Frame AgglomerateReader::frame(std::size_t t) const {
  if (t >= info_.frames)
    throw InputError(fmt::format("{}: frame {} does not exist, it has {} (counted from 0)", name_, t, info_.frames));
  Frame frame;
  frame.step = steps_[t];
  frame.time = times_[t];
  frame.position = vectors(positions, t, 1);
  const auto optional = [&](const std::string& name, std::vector<Vector3>& field) {
    if (has("/particles/all/" + name)) field = vectors("/particles/all/" + name, t, 1);
  };
  optional("velocity", frame.velocity);
  optional("angular_velocity", frame.angular_velocity);
  optional("force", frame.force);
  optional("torque", frame.torque);
  if (has("/particles/all/orientation")) {
    const auto q = real_rows("/particles/all/orientation", t, 1);
    for (std::size_t k = 0; k < q.size(); k += 4) frame.orientation.emplace_back(q[k], q[k + 1], q[k + 2], q[k + 3]);
  }
  const auto first = static_cast<std::uint64_t>(offsets_[t]);
  frame.contacts = contacts(first, static_cast<std::uint64_t>(offsets_[t + 1]) - first);
  return frame;
}

std::vector<std::string> AgglomerateReader::observable_names() const {
  return file_.kind("/observables") == Kind::group ? file_.group("/observables").names() : std::vector<std::string>{};
}

std::vector<double> AgglomerateReader::observable(const std::string& name) const {
  return real_rows("/observables/" + name, 0, info_.frames);
}

std::string AgglomerateReader::text(const std::string& path) const {
  return file_.kind(path) == Kind::dataset ? file_.dataset(path).read_text() : "";
}

std::string AgglomerateReader::input() const { return text("/parameters/input"); }
std::string AgglomerateReader::resolved() const { return text("/parameters/resolved"); }

Agglomerate read_agglomerate(const std::filesystem::path& path, std::optional<std::size_t> frame) {
  const auto read = [&] {
    const AgglomerateReader reader(path, AgglomerateReader::Unprotected{});
    return Agglomerate{reader.particles(), frame ? reader.frame(*frame) : reader.last_frame()};
  };
  in_child(path, [&] { return read(), require_valid(path), std::string(); });
  return read();
}

Agglomerate read_agglomerate(const std::filesystem::path& path) { return read_agglomerate(path, std::nullopt); }

FileInfo read_info(const std::filesystem::path& path) {
  const auto read = [&] { return AgglomerateReader(path, AgglomerateReader::Unprotected{}).info(); };
  in_child(path, [&] { return read(), require_valid(path), std::string(); });
  return read();
}

}  // namespace crumble
