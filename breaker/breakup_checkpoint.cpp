#include "breaker/breakup_checkpoint.hpp"

#include <filesystem>

namespace crumble {

namespace {

// A frame as numbers; loads of the contacts are stored too, since the next step starts from them.
void store(const Frame& f, std::vector<double>& numbers, std::vector<std::int64_t>& counts) {
  numbers.push_back(f.time);
  counts.insert(counts.end(),
                {f.step, static_cast<std::int64_t>(f.position.size()), static_cast<std::int64_t>(f.contacts.size())});
  for (const Vector3& x : f.position) numbers.insert(numbers.end(), x.begin(), x.end());
  for (const Quaternion& q : f.orientation) numbers.insert(numbers.end(), {q.w(), q.x(), q.y(), q.z()});
  for (const Contact& c : f.contacts) {
    for (const Vector3* v : {&c.normal, &c.sliding, &c.rolling, &c.sliding_force, &c.rolling_torque})
      numbers.insert(numbers.end(), v->begin(), v->end());
    numbers.insert(numbers.end(), {c.gap, c.twisting, c.normal_force, c.twisting_torque});
    counts.insert(counts.end(), {c.i, c.j, c.born, c.at_limit});
  }
}

Frame restore(std::vector<double>::const_iterator& number, std::vector<std::int64_t>::const_iterator& count) {
  Frame f;
  f.time = *number++;
  f.step = *count++;
  const auto n = static_cast<std::size_t>(*count++), m = static_cast<std::size_t>(*count++);
  f.position.resize(n);
  f.orientation.resize(n);
  f.contacts.resize(m);
  for (Vector3& x : f.position)
    for (double& v : x) v = *number++;
  for (Quaternion& q : f.orientation)
    for (double* v : {&q.w(), &q.x(), &q.y(), &q.z()}) *v = *number++;
  for (Contact& c : f.contacts) {
    for (Vector3* target : {&c.normal, &c.sliding, &c.rolling, &c.sliding_force, &c.rolling_torque})
      for (double& v : *target) v = *number++;
    for (double* v : {&c.gap, &c.twisting, &c.normal_force, &c.twisting_torque}) *v = *number++;
    c.i = static_cast<std::int32_t>(*count++);
    c.j = static_cast<std::int32_t>(*count++);
    c.born = *count++;
    c.at_limit = static_cast<std::uint8_t>(*count++);
  }
  return f;
}

std::string piece_name(const char* what, std::size_t k) { return what + std::string("_") + std::to_string(k); }

}  // namespace

BreakupCheckpoint::BreakupCheckpoint(const std::string& output, CheckpointOwner owner)
    : path_(output + ".checkpoint"),
      owner_(std::move(owner)),
      found_(std::filesystem::exists(path_) && std::filesystem::exists(output + ".tmp")) {
  if (found_) stored_ = load_checkpoint(path_, owner_);
}

void BreakupCheckpoint::save(const BreakupRun& run, const Progression& progression) const {
  const BreakupRun::Memory m = run.memory();
  Checkpoint out;
  out.reals["run"] = m.numbers;
  out.integers["run_counts"] = m.counts;
  out.integers["pieces"] = {static_cast<std::int64_t>(m.frames.size())};
  store(m.whole, out.reals["whole"], out.integers["whole_counts"]);
  for (std::size_t k = 0; k < m.frames.size(); ++k) {
    store(m.frames[k], out.reals[piece_name("piece", k)], out.integers[piece_name("piece_counts", k)]);
    out.integers[piece_name("member", k)] = m.members[k];
    out.integers[piece_name("told", k)] = m.told[k];
    out.reals[piece_name("integrator", k)] = m.integrators[k].numbers;
    out.integers[piece_name("integrator_counts", k)] = m.integrators[k].counts;
  }
  out.reals["progression"] = {progression.next_sample, progression.next_frame};
  out.integers["last_step"] = {progression.last_step};
  if (progression.companion) out.reals["companion"] = {*progression.companion};
  save_checkpoint(path_, owner_, out);
}

void BreakupCheckpoint::resume(BreakupRun& run, Progression& progression) const {
  BreakupRun::Memory m;
  m.numbers = stored_.real("run");
  m.counts = stored_.integer("run_counts");
  const auto frame = [&](const std::string& reals, const std::string& integers) {
    auto number = stored_.real(reals).begin();
    auto count = stored_.integer(integers).begin();
    return restore(number, count);
  };
  m.whole = frame("whole", "whole_counts");
  const auto pieces = static_cast<std::size_t>(stored_.integer("pieces").at(0));
  for (std::size_t k = 0; k < pieces; ++k) {
    m.frames.push_back(frame(piece_name("piece", k), piece_name("piece_counts", k)));
    m.members.push_back(stored_.integer(piece_name("member", k)));
    m.told.push_back(stored_.integer(piece_name("told", k)));
    m.integrators.push_back(
        {stored_.real(piece_name("integrator", k)), stored_.integer(piece_name("integrator_counts", k))});
  }
  run.recall(m);
  progression.next_sample = stored_.real("progression").at(0);
  progression.next_frame = stored_.real("progression").at(1);
  progression.last_step = stored_.integer("last_step").at(0);
  if (stored_.reals.contains("companion")) progression.companion = stored_.real("companion").at(0);
}

void BreakupCheckpoint::remove() const { std::filesystem::remove(path_); }

}  // namespace crumble
