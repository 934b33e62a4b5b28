#include "dryer/drying_checkpoint.hpp"

#include <filesystem>

#include "dryer/start.hpp"

namespace crumble {

namespace {

std::vector<double> flat(const std::vector<Vector3>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Vector3& v : vectors) values.insert(values.end(), v.begin(), v.end());
  return values;
}

std::vector<Vector3> vectors(const std::vector<double>& values) {
  std::vector<Vector3> result;
  for (std::size_t k = 0; k + 2 < values.size(); k += 3) result.emplace_back(values[k], values[k + 1], values[k + 2]);
  return result;
}

// A contact as numbers; loads are stored too, since the next step starts from them.
constexpr std::size_t numbers_of_contact = 20;

void add_numbers(const Contact& c, std::vector<double>& values) {
  for (const Vector3* v : {&c.normal, &c.sliding, &c.rolling, &c.sliding_force, &c.rolling_torque})
    values.insert(values.end(), v->begin(), v->end());
  values.insert(values.end(), {c.gap, c.twisting, c.normal_force, c.twisting_torque, static_cast<double>(c.at_limit)});
}

Contact contact(const double* v, const std::int64_t* k) {
  Contact c;
  c.i = static_cast<std::int32_t>(k[0]);
  c.j = static_cast<std::int32_t>(k[1]);
  c.born = k[2];
  for (Vector3* target : {&c.normal, &c.sliding, &c.rolling, &c.sliding_force, &c.rolling_torque}) {
    *target = Vector3(v[0], v[1], v[2]);
    v += 3;
  }
  c.gap = v[0];
  c.twisting = v[1];
  c.normal_force = v[2];
  c.twisting_torque = v[3];
  c.at_limit = static_cast<std::uint8_t>(v[4]);
  return c;
}

}  // namespace

DryingCheckpoint::DryingCheckpoint(const std::string& output, CheckpointOwner owner)
    : path_(output + ".checkpoint"),
      owner_(std::move(owner)),
      found_(std::filesystem::exists(path_) && std::filesystem::exists(output + ".tmp")) {
  if (found_) stored_ = load_checkpoint(path_, owner_);
}

void DryingCheckpoint::save(const DryingRun& run, const std::optional<DryingOutcome>& companion, int frames,
                            std::int64_t last_frame_step) const {
  const Frame& f = run.state().state;
  Checkpoint out;
  out.reals["time"] = {f.time};
  out.integers["step"] = {f.step};
  out.integers["frames"] = {frames, last_frame_step};
  out.reals["position"] = flat(f.position);
  out.reals["velocity"] = flat(f.velocity);
  out.reals["angular_velocity"] = flat(f.angular_velocity);
  out.reals["force"] = flat(f.force);
  out.reals["torque"] = flat(f.torque);
  auto& numbers = out.reals["contacts"];
  auto& counts = out.integers["contacts_between"];
  for (const Contact& c : f.contacts) {
    add_numbers(c, numbers);
    counts.insert(counts.end(), {c.i, c.j, c.born});
  }
  const Integrator::Memory memory = run.integrator().memory();
  out.reals["integrator"] = memory.numbers;
  out.integers["integrator_counts"] = memory.counts;
  out.integers["active"].assign(memory.active.begin(), memory.active.end());
  if (companion) out.reals["companion"] = {companion->d_c, companion->h_c_over_d_c, companion->contacts};
  save_checkpoint(path_, owner_, out);
}

DryingRun DryingCheckpoint::resume(const DryingScene& scene) const {
  Agglomerate state =
      random_suspension(scene.radius, scene.model.material.density, scene.model.droplet.initial_radius, scene.seed);
  Frame& f = state.state;
  f.time = stored_.real("time").at(0);
  f.step = stored_.integer("step").at(0);
  f.position = vectors(stored_.real("position"));
  f.velocity = vectors(stored_.real("velocity"));
  f.angular_velocity = vectors(stored_.real("angular_velocity"));
  f.force = vectors(stored_.real("force"));
  f.torque = vectors(stored_.real("torque"));
  const auto& numbers = stored_.real("contacts");
  const auto& counts = stored_.integer("contacts_between");
  for (std::size_t c = 0; 3 * c < counts.size(); ++c)
    f.contacts.push_back(contact(numbers.data() + numbers_of_contact * c, counts.data() + 3 * c));
  Integrator::Memory memory;
  memory.numbers = stored_.real("integrator");
  memory.counts = stored_.integer("integrator_counts");
  memory.active.assign(stored_.integer("active").begin(), stored_.integer("active").end());
  return DryingRun(scene, 1, std::move(state), memory);
}

std::optional<DryingOutcome> DryingCheckpoint::companion() const {
  if (!stored_.reals.contains("companion")) return std::nullopt;
  const auto& c = stored_.real("companion");
  return DryingOutcome{c.at(0), c.at(1), c.at(2)};
}

int DryingCheckpoint::frames() const { return static_cast<int>(stored_.integer("frames").at(0)); }
std::int64_t DryingCheckpoint::last_frame_step() const { return stored_.integer("frames").at(1); }

void DryingCheckpoint::remove() const { std::filesystem::remove(path_); }

}  // namespace crumble
