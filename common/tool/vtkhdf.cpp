#include "common/tool/vtkhdf.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/agglomerate/fragments.hpp"
#include "common/agglomerate/morphology.hpp"
#include "common/io/hdf5.hpp"
#include "common/io/output_file.hpp"

namespace crumble::tool {
namespace {

constexpr double per_nm = 1e9;
constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3;

template <class T>
void put(hdf5::Group& group, const std::string& path, const std::vector<T>& values, std::uint64_t width = 1) {
  hdf5::Shape shape{values.size() / width};
  if (width > 1) shape.push_back(width);
  group.create_dataset<T>(path, shape).template write<T>(values);
}

std::vector<double> numbers(const std::vector<Vector3>& vectors, double factor) {
  std::vector<double> out;
  out.reserve(3 * vectors.size());
  for (const Vector3& v : vectors) out.insert(out.end(), {factor * v.x(), factor * v.y(), factor * v.z()});
  return out;
}

void put_grid(hdf5::Group& grid, const Particles& particles, const Frame& frame) {
  const auto points = static_cast<std::int64_t>(particles.size());
  const auto lines = static_cast<std::int64_t>(frame.contacts.size());
  std::vector<std::int64_t> connectivity, offsets{0};
  std::vector<std::uint8_t> types;
  const auto close_cell = [&](std::uint8_t type) {
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    types.push_back(type);
  };
  for (std::int64_t i = 0; i < points; ++i) {
    connectivity.push_back(i);
    close_cell(vtk_vertex);
  }
  for (const Contact& c : frame.contacts) {
    connectivity.insert(connectivity.end(), {c.i, c.j});
    close_cell(vtk_line);
  }
  put<std::int64_t>(grid, "NumberOfPoints", {points});
  put<std::int64_t>(grid, "NumberOfCells", {points + lines});
  put<std::int64_t>(grid, "NumberOfConnectivityIds", {static_cast<std::int64_t>(connectivity.size())});
  put(grid, "Points", numbers(frame.position, per_nm), 3);
  put(grid, "Connectivity", connectivity);
  put(grid, "Offsets", offsets);
  put(grid, "Types", types);
}

void put_point_data(hdf5::Group& data, const Particles& particles, const Frame& frame) {
  std::vector<double> radius = particles.radius;
  for (double& a : radius) a *= per_nm;
  put(data, "radius", radius);
  put(data, "id", particles.id);
  put(data, "fragment", fragments(particles.size(), frame.contacts));
  put(data, "coordination", coordination(particles.size(), frame.contacts));
  const auto vectors = [&](const char* name, const std::vector<Vector3>& values) {
    if (!values.empty()) put(data, name, numbers(values, 1), 3);
  };
  vectors("velocity", frame.velocity);
  vectors("angular_velocity", frame.angular_velocity);
  vectors("force", frame.force);
  vectors("torque", frame.torque);
  if (frame.orientation.empty()) return;
  std::vector<double> orientation;  // scalar first, as in the agglomerate file
  for (const Quaternion& q : frame.orientation) orientation.insert(orientation.end(), {q.w(), q.x(), q.y(), q.z()});
  put(data, "orientation", orientation, 4);
}

void put_cell_data(hdf5::Group& data, const Particles& particles, const Frame& frame) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t points = particles.size();
  std::vector<std::uint8_t> is_contact(points, 0), at_limit(points, 0);
  is_contact.resize(points + frame.contacts.size(), 1);
  for (const Contact& c : frame.contacts) at_limit.push_back(c.at_limit);
  put(data, "contact", is_contact);
  put(data, "at_limit", at_limit);
  const auto scalar = [&](const char* name, double Contact::*member, double factor) {
    std::vector<double> values(points, none);
    for (const Contact& c : frame.contacts) values.push_back(factor * c.*member);
    put(data, name, values);
  };
  const auto vector = [&](const char* name, Vector3 Contact::*member) {
    std::vector<Vector3> values(points, Vector3::Constant(none));
    for (const Contact& c : frame.contacts) values.push_back(c.*member);
    put(data, name, numbers(values, 1), 3);
  };
  scalar("gap", &Contact::gap, per_nm);
  scalar("normal_force", &Contact::normal_force, 1);
  scalar("twisting_torque", &Contact::twisting_torque, 1);
  vector("sliding_force", &Contact::sliding_force);
  vector("rolling_torque", &Contact::rolling_torque);
}

}  // namespace

void write_vtkhdf(const std::filesystem::path& name, const Particles& particles, const Frame& frame) {
  const std::filesystem::path path = followed(name);
  const std::filesystem::path temporary = path.string() + ".tmp";
  try {
    hdf5::File file = hdf5::File::create(temporary);
    hdf5::Group grid = file.create_group("/VTKHDF");
    const std::array<std::int64_t, 2> version{1, 0};
    grid.set_attribute<std::int64_t>("Version", version);
    grid.set_fixed_text_attribute("Type", "UnstructuredGrid");  // VTK does not read variable-length text
    put_grid(grid, particles, frame);
    hdf5::Group points = file.create_group("/VTKHDF/PointData");
    put_point_data(points, particles, frame);
    hdf5::Group cells = file.create_group("/VTKHDF/CellData");
    put_cell_data(cells, particles, frame);
    cells = {};
    points = {};
    grid = {};
    file.close();
    publish(temporary, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

std::string series_text(const std::vector<std::pair<std::string, double>>& file_and_time) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const auto& [name, time] : file_and_time) files.push_back({{"name", name}, {"time", time}});
  return nlohmann::ordered_json{{"file-series-version", "1.0"}, {"files", files}}.dump(2) + "\n";
}

}  // namespace crumble::tool
