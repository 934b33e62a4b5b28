#include "rigidstress/stress_file.hpp"

#include <algorithm>

#include "common/io/agglomerate_reader.hpp"

namespace crumble::rigidstress {

namespace {

using Span = std::span<const double>;

// Rows of a matrix as a file has them.
void push_rows(std::vector<double>& values, const Eigen::MatrixXd& matrix) {
  for (Eigen::Index r = 0; r < matrix.rows(); ++r)
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) values.push_back(matrix(r, c));
}

void write_response(AgglomerateWriter& writer, const Analysis& analysis) {
  const auto& contacts = analysis.prepared.frame.contacts;
  const std::uint64_t count = contacts.size();
  std::vector<std::int32_t> pair;
  for (const Contact& c : contacts) pair.insert(pair.end(), {c.i, c.j});
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(count), 5);
  std::vector<double> velocity, drag, loads, basis;
  for (const BodyResult& b : analysis.bodies) {
    const Response& r = b.loaded.response;
    push_rows(velocity, r.drift);
    push_rows(drag, r.drag);
    for (std::size_t k = 0; k < b.body.contact.size(); ++k)
      load.middleRows(6 * b.body.contact[k], 6) = r.load.middleRows(6 * static_cast<Eigen::Index>(k), 6);
  }
  push_rows(loads, load);
  for (int k = 0; k < 5; ++k) push_rows(basis, strain_tensor(Vector5::Unit(k)));
  const std::uint64_t parts = analysis.bodies.size();
  writer.put<std::int32_t>("/response/pair", pair, {count, 2});
  writer.put<double>("/response/load", loads, {count, 6, 5},
                     "for a viscosity of 1 Pa s; force on j, then moment about the contact point, which divides the "
                     "distance of centres in the ratio of the radii",
                     "N s; N m s");
  writer.put<double>("/response/velocity", Span(velocity).first(30), {6, 5}, "", "m; 1");
  writer.put<double>("/response/basis", basis, {5, 3, 3});
  writer.put<double>("/response/body_velocity", velocity, {parts, 6, 5}, "", "m; 1");
  writer.put<double>("/response/body_drag", drag, {parts, 6, 6}, "for a viscosity of 1 Pa s", "N s m-1; N s; N m s");
  if (analysis.error) writer.put("/response/error", *analysis.error, analysis.how);
  writer.put_attribute("/response@hydrodynamics", analysis.method);
}

void write_closing(AgglomerateWriter& writer, const Prepared& p) {
  writer.put("/closing/residual_rms", p.residual_rms);
  writer.put("/closing/residual_max", p.residual_max);
  writer.put("/closing/lost_contacts", static_cast<double>(p.lost.size()));
  writer.put("/closing/scale", p.scale);
}

// What one flow does to all contacts, and the path of the weakest body.
struct FlowRecord {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  std::vector<double> tension;  // of each contact, N
  std::vector<Quaternion> orientation;
  std::vector<double> time, max_tension, share;
  double critical_stress = 0;  // Pa; 0: nothing breaks
  std::string instant;         // which one `tension` belongs to
};

void write_flow(AgglomerateWriter& writer, const std::string& name, const Analysis& a, const FlowRecord& record) {
  const std::string place = "/flows/" + name + "/";
  const std::uint64_t count = record.tension.size();
  std::vector<double> gradient, radial(count), orientation;
  push_rows(gradient, record.gradient);
  for (const BodyResult& b : a.bodies)
    for (const int k : b.body.contact) {
      const Contact& c = a.prepared.frame.contacts[k];
      radial[k] = (0.5 * (a.prepared.position[c.i] + a.prepared.position[c.j]) - b.centre).norm();
    }
  for (const Quaternion& q : record.orientation) orientation.insert(orientation.end(), {q.w(), q.x(), q.y(), q.z()});
  writer.put<double>(place + "gradient", gradient, {3, 3});
  writer.put<double>(place + "normal_force", record.tension, {count}, record.instant);
  writer.put<double>(place + "radial_position", radial, {count});
  if (!record.time.empty()) {
    writer.put<double>(place + "time", record.time, {record.time.size()});
    writer.put<double>(place + "max_tension", record.max_tension, {record.max_tension.size()});
  }
  if (!record.orientation.empty())
    writer.put<double>(place + "orientation", orientation, {record.orientation.size(), 4});
  if (!record.share.empty()) writer.put<double>(place + "share", record.share, {record.share.size()});
  if (record.critical_stress > 0) writer.put(place + "critical_stress", record.critical_stress);
}

void set_tensions(FlowRecord& record, const BodyResult& b, const Vector5& strain, double factor) {
  const Eigen::VectorXd n = factor * b.loaded.tensions(strain);
  for (std::size_t k = 0; k < b.body.contact.size(); ++k)
    record.tension[b.body.contact[k]] = n[static_cast<Eigen::Index>(k)];
}

FlowRecord empty_record(const Analysis& a, const Eigen::Matrix3d& gradient, const std::string& instant) {
  FlowRecord record;
  record.gradient = gradient;
  record.tension.assign(a.prepared.frame.contacts.size(), 0.0);
  record.instant = instant;
  return record;
}

constexpr const char* at_one_pascal = " at a flow stress mu gamma_dot of 1 Pa and gamma_dot = 1/s";

void write_straining(AgglomerateWriter& writer, const std::string& name, const Analysis& a,
                     const Eigen::Matrix3d& gradient, std::optional<StrainingResult> BodyResult::*which) {
  FlowRecord settled =
      empty_record(a, gradient, std::string("settled orientation reached most often,") + at_one_pascal);
  FlowRecord worst = empty_record(a, gradient, std::string("orientation that loads one contact most,") + at_one_pascal);
  for (const BodyResult& b : a.bodies) {
    const StrainingResult& r = *(b.*which);
    if (b.loaded.pull_off.empty()) continue;
    set_tensions(worst, b, TurningBody::strain_seen(r.worst_orientation, gradient), 1);
    if (!r.attractors.empty())
      set_tensions(settled, b, TurningBody::strain_seen(r.attractors.front().orientation, gradient), 1);
  }
  const StrainingResult& r = *(a.weakest().*which);
  for (const Attractor& attractor : r.attractors) {
    settled.orientation.push_back(attractor.orientation);
    settled.share.push_back(attractor.share);
  }
  if (!r.attractors.empty() && r.attractors.front().peak.use > 0)
    settled.critical_stress = 1 / r.attractors.front().peak.use;
  worst.orientation.push_back(r.worst_orientation);
  if (r.worst.use > 0) worst.critical_stress = 1 / r.worst.use;
  write_flow(writer, name, a, settled);
  write_flow(writer, name + "-worst", a, worst);
}

void add_orbit(FlowRecord& record, const Orbit& orbit, double factor) {
  record.time = orbit.time;
  record.orientation = orbit.orientation;
  record.max_tension = orbit.max_tension;
  for (double& n : record.max_tension) n *= factor;
}

void write_shear(AgglomerateWriter& writer, const Analysis& a) {
  const Eigen::Matrix3d gradient = unit_gradient(FlowKind::shear);
  FlowRecord record = empty_record(a, gradient, std::string("worst instant of the worst orbit,") + at_one_pascal);
  for (const BodyResult& b : a.bodies) {
    const Orbit& orbit = b.shear->orbits[b.shear->worst_orbit];
    set_tensions(record, b, TurningBody::strain_seen(orbit.orientation[orbit.peak_at], gradient), 1);
  }
  const Orbit& orbit = a.weakest().shear->orbits[a.weakest().shear->worst_orbit];
  add_orbit(record, orbit, 1);
  if (orbit.peak.use > 0) record.critical_stress = 1 / orbit.peak.use;
  write_flow(writer, "shear", a, record);
}

void write_history(AgglomerateWriter& writer, const Analysis& a, const StressScene& scene) {
  const GradientHistory& history = *scene.history;
  const HistoryResult& r = *a.weakest().history;
  const Orbit& orbit = r.orbits[r.worst_orbit];
  FlowRecord record = empty_record(a, history(orbit.time[orbit.peak_at]) / history.largest_rate(),
                                   "worst instant of the worst orbit; gradient: of that instant");
  for (const BodyResult& b : a.bodies) {
    const Orbit& path = b.history->orbits[b.history->worst_orbit];
    const double t = path.time[path.peak_at];
    set_tensions(record, b, TurningBody::strain_seen(path.orientation[path.peak_at], history(t)),
                 scene.liquid.viscosity);
  }
  add_orbit(record, orbit, scene.liquid.viscosity);
  if (orbit.peak.use > 0) record.critical_stress = history.largest_rate() / orbit.peak.use;
  write_flow(writer, "history", a, record);
}

Eigen::MatrixXd matrix_at(const std::vector<double>& values, std::size_t first, int rows, int columns) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data() + first, rows, columns);
}

// Without building the network, which would factorise it.
int count_bridges(const Prepared& p, const Body& body) {
  std::vector<int> row(p.particles.size(), -1);
  for (std::size_t k = 0; k < body.particle.size(); ++k) row[body.particle[k]] = static_cast<int>(k);
  std::vector<Joint> joints;
  for (const int k : body.contact) {
    const Contact& c = p.frame.contacts[k];
    joints.push_back({.i = row[c.i], .j = row[c.j]});
  }
  const std::vector<bool> bridge = network_tree(static_cast<int>(body.particle.size()), joints).bridge;
  return static_cast<int>(std::count(bridge.begin(), bridge.end(), true));
}

Prepared restored_agglomerate(const AgglomerateReader& reader, const hdf5::File& file) {
  Prepared p;
  p.particles = reader.particles();
  p.frame = reader.last_frame();
  p.position = touching_positions(p.particles, p.frame);
  p.scale = file.dataset("/closing/scale").read<double>().at(0);
  p.residual_rms = file.dataset("/closing/residual_rms").read<double>().at(0);
  p.residual_max = file.dataset("/closing/residual_max").read<double>().at(0);
  p.lost.resize(static_cast<std::size_t>(file.dataset("/closing/lost_contacts").read<std::int64_t>().at(0)));
  return p;
}

}  // namespace

void write_stress(AgglomerateWriter& writer, const Analysis& analysis, const StressScene& scene) {
  writer.append(analysis.prepared.frame);
  write_closing(writer, analysis.prepared);
  write_response(writer, analysis);
  if (scene.elongation)
    write_straining(writer, "elongation", analysis, unit_gradient(FlowKind::elongation), &BodyResult::elongation);
  if (scene.uniaxial)
    write_straining(writer, "uniaxial", analysis, unit_gradient(FlowKind::uniaxial), &BodyResult::uniaxial);
  if (scene.biaxial)
    write_straining(writer, "biaxial", analysis, unit_gradient(FlowKind::biaxial), &BodyResult::biaxial);
  if (scene.shear) write_shear(writer, analysis);
  if (scene.history) write_history(writer, analysis, scene);
}

std::optional<Analysis> restore(const std::filesystem::path& path, const Scene& text, const StressScene& scene) {
  const AgglomerateReader reader(path);
  if (reader.info().stage != "rigidstress") return std::nullopt;
  const hdf5::File file = hdf5::File::open(path);
  if (file.kind("/response/load") != hdf5::Kind::dataset) return std::nullopt;
  const Scene before =
      Scene::parse_stored(reader.resolved(), path.string() + ":/parameters/resolved", stress_parameters());
  if (response_key(before) != response_key(text)) return std::nullopt;

  Analysis a;
  a.restored = true;
  a.prepared = restored_agglomerate(reader, file);
  const auto load = file.dataset("/response/load").read<double>();
  const auto velocity = file.dataset("/response/body_velocity").read<double>();
  const auto drag = file.dataset("/response/body_drag").read<double>();
  std::vector<Body> parts = bodies(a.prepared);
  if (load.size() != 30 * a.prepared.frame.contacts.size() || velocity.size() != 30 * parts.size() ||
      drag.size() != 36 * parts.size())
    throw ContentError(path.string() + ": /response does not fit the contacts of the file");
  if (file.kind("/response/error") == hdf5::Kind::dataset) {
    const auto error = file.dataset("/response/error");
    a.error = error.read<double>().at(0);
    a.how = error.text_attribute("method").at(0);
  } else {
    a.how = "not estimated when the response was computed";
  }
  a.method = file.group("/response").text_attribute("hydrodynamics").at(0);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    BodyResult b;
    b.centre = centre_of(a.prepared, parts[k]);
    Response& r = b.loaded.response;
    r.centre = b.centre;
    r.drift = matrix_at(velocity, 30 * k, 6, 5);
    r.drag = matrix_at(drag, 36 * k, 6, 6);
    r.load.resize(6 * static_cast<Eigen::Index>(parts[k].contact.size()), 5);
    std::vector<Vector3> normal;
    for (std::size_t row = 0; row < parts[k].contact.size(); ++row) {
      const Contact& c = a.prepared.frame.contacts[parts[k].contact[row]];
      normal.push_back((a.prepared.position[c.j] - a.prepared.position[c.i]).normalized());
      r.load.middleRows(6 * static_cast<Eigen::Index>(row), 6) =
          matrix_at(load, 30 * static_cast<std::size_t>(parts[k].contact[row]), 6, 5);
    }
    r.tension = tension_rows(r.load, normal);
    b.loaded.pull_off = pull_off_of(a.prepared, parts[k], scene.material, scene.surface_forces);
    b.bridges = count_bridges(a.prepared, parts[k]);
    b.body = std::move(parts[k]);
    a.bodies.push_back(std::move(b));
  }
  return a;
}

}  // namespace crumble::rigidstress
